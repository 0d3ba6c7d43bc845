#include "tests/support/plan_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/safety/checker.h"
#include "planner/start_clearance.h"

namespace tern::support {
namespace {

constexpr Duration kStep{5'000};

std::string fault_of_new(const Plan& plan, const HorizonRequest& request,
                         const std::vector<PlanningObstacle>& obstacles, const PlannerConfig& config) {
  if (plan.trajectory.start != request.t_s) return "does not begin at t_s";
  const double to_goal = (plan.trajectory.control_points.rightCols<1>() - plan.local_goal).norm();
  if (std::abs(plan.cost.distance_to_goal - to_goal) > 1e-9) return "its cost is of another local goal";
  const int intervals = static_cast<int>(plan.trajectory.control_points.cols()) - 3;
  std::vector<double> times;
  for (int k = 0; k <= intervals; ++k) times.push_back(k * plan.trajectory.interval.seconds());
  const SweptObstacles swept(obstacles, request.body, request.t_s, times,
                             Box(Vec3::Constant(-1e5), Vec3::Constant(1e5)));
  SeparationCache cache(swept);
  HorizonProblem problem;
  problem.start = request.start;
  problem.limits = request.limits;
  problem.sphere_radius = config.sphere_radius_m;
  problem.centre_box = centre_box(request.flight_box, request.body);
  const CheckReport report = check_plan(plan.trajectory, problem, cache);
  if (report.ok()) return "";
  return fmt::format("the checker: {}, interval {}, obstacle {}", report.text(), report.interval, report.obstacle);
}

bool same(const TimedSpline& a, const TimedSpline& b) {
  return a.start == b.start && a.interval == b.interval && a.control_points == b.control_points;
}

}  // namespace

std::vector<PlanningObstacle> obstacles_for(const HorizonRequest& request, const PlanningWorld& world,
                                            const Assurance& assurance) {
  std::vector<PlanningObstacle> obstacles = world.predictions->obstacles;
  std::int64_t id = -1;
  const std::optional<PoseError>& error = world.predictions->set.pose_error;
  for (const Box& box : world.map->occupied.boxes()) {
    const Vec3 nearest = request.start.p.cwiseMax(box.min()).cwiseMin(box.max());
    const double margin = error ? error->margin(nearest) : 0.0;
    obstacles.push_back({id--, nullptr, grown(box, Vec3::Constant(margin)), {}, nullptr, margin});
  }
  apply_assurance(assurance, request.t_s, obstacles);
  (void)clear_start(obstacles, request.body, request.start.p, request.t_s);
  return obstacles;
}

std::string fault_of(const Plan& plan, const HorizonRequest& request, const PlanningWorld& world,
                     const PlannerConfig& config) {
  if (plan.request_id != request.id) return "answers another request";
  if (plan.outcome == PlanOutcome::NoPlan) return "";
  const auto obstacles = obstacles_for(request, world, {plan.level, plan.alpha_scale, plan.sure_for});
  if (plan.outcome == PlanOutcome::KeepCommitted) {
    if (!same(plan.trajectory, request.committed)) return "keeps what was not committed";
  } else if (std::string fault = fault_of_new(plan, request, obstacles, config); !fault.empty()) {
    return fault;
  }
  const UTime moves_until = std::max(plan.trajectory.end(), request.t_s);
  if (moves_until > request.t_s &&
      least_gap(plan.trajectory, request.body, obstacles, request.t_s, moves_until, kStep) <= 0.0) {
    return "touches an obstacle under way";
  }
  if (plan.hold.us > 0 &&
      least_gap(plan.trajectory, request.body, obstacles, moves_until, moves_until + plan.hold, kStep) <= 0.0) {
    return "touches an obstacle during its hold";
  }
  return "";
}

Plan Loop::step(const std::function<PlanningWorld(const HorizonRequest&)>& world_at) {
  HorizonRequest request = request_at(t_s, committed);
  request.id = static_cast<std::int64_t>(outcomes.size()) + 1;
  request.limits = limits;
  request.body = body;
  request.flight_box = flight_box;
  Budget budget = Budget::unlimited();
  const Plan answer = plan(request, world_at(request), config, budget).plan;
  outcomes.push_back(answer.outcome);
  if (answer.outcome != PlanOutcome::KeepCommitted && answer.outcome != PlanOutcome::NoPlan)
    committed = answer.trajectory;
  t_s = t_s + period;
  return answer;
}

}  // namespace tern::support
