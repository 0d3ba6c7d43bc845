#include "benchmarks/recorded_problems.h"

#include "planner/plan_workspace.h"
#include "simulator/worlds/declared_motions.h"
#include "simulator/worlds/world.h"
#include "tests/support/plan_judge.h"

namespace tern::benchmarks {
namespace {

constexpr UTime kWorldZero{100'000'000};
constexpr Duration kAhead{3'500'000};
constexpr int kMostRequests = 600;

/// As scenarios/*.yaml have them.
Scenario scenario_of(const std::string& world, std::uint64_t seed) {
  Scenario s;
  s.seed = seed;
  s.world.generator = world;
  s.world.count = world == "paper_corridor" ? 300 : world == "mader_corridor" ? 250 : 200;
  s.uav.flight_box = Box(Vec3(-100, -3, 0), Vec3(200, 3, 4));
  if (world == "mader_corridor") {
    s.uav.goal = Vec3(75, 0, 1);
    s.uav.limits.v_max = Vec3::Constant(5.0);
    s.uav.limits.a_max = Vec3::Constant(20.0);
  } else if (world == "sando_forest") {
    s.uav.start = Vec3(0, 0, 2);
    s.uav.goal = Vec3(105, 0, 2);
    s.uav.limits.v_max = Vec3::Constant(5.0);
    s.uav.limits.a_max = Vec3::Constant(20.0);
    s.uav.limits.j_max = Vec3::Constant(100.0);
    s.uav.flight_box = Box(Vec3(-100, -8, 0.5), Vec3(200, 8, 4.5));
  }
  return s;
}

/// What the answer's search posed to the optimizer.
std::optional<RecordedProblem> problem_of(const HorizonRequest& request, const PlanningWorld& world, const Plan& answer,
                                          const PlannerConfig& config) {
  if (answer.outcome != PlanOutcome::Optimized && answer.outcome != PlanOutcome::SearchOnly) return std::nullopt;
  PlanWorkspace memory;
  PlanLog log(nullptr);
  Budget budget = Budget::unlimited();
  PlanTools tools{budget, memory, log};
  Limits limits = request.limits;
  limits.v_max *= config.velocity_share;
  const Surroundings near{request, config, world.predictions->obstacles, {}, {}, {}, limits, nullptr};
  const Heading heading{{answer.local_goal, 0.0, 0.0}, {answer.local_goal, 0.0}, 0.0, limits, nullptr};
  const Attempt attempt{near, heading, horizon_problem(near, answer.trajectory.interval), config.hold_cap_s,
                        config.hold_required_s};
  sweep_horizon(attempt, memory.times, memory.horizon);
  const auto leaf = search_candidate(attempt, config.search, memory.horizon, tools);
  if (!leaf) return std::nullopt;
  const Points& initial = leaf->trajectory.control_points;
  return RecordedProblem{trajectory_problem(attempt, initial),
                         gather_pairs(attempt, leaf->trajectory, memory.horizon, tools), initial};
}

}  // namespace

ConvexProblem RecordedProblem::convex() const {
  std::vector<PlaneConstraint> planes;
  for (const SeparatedPair& pair : pairs) planes.push_back(pair.plane);
  return make_convex_problem(trajectory, planes, initial);
}

int record_problems(const std::string& world, std::uint64_t seed,
                    const std::function<bool(const RecordedProblem&)>& take) {
  const Scenario scenario = scenario_of(world, seed);
  const World made = *make_world(scenario, "");
  const PlannerConfig config;
  support::Loop loop{kWorldZero, support::resting_at(scenario.uav.start, kWorldZero), scenario.uav.limits,
                     scenario.uav.body, config};
  loop.flight_box = scenario.uav.flight_box;
  HorizonRequest request = support::request_at(kWorldZero, loop.committed);
  request.flight_box = scenario.uav.flight_box;
  PlanningWorld now = support::world_of(declare_motions(made, kWorldZero, kWorldZero, kWorldZero + kAhead).tracks,
                                        support::go_to(scenario.uav.goal), request, config);
  int taken = 0;
  for (int k = 0; k < kMostRequests && (loop.now().p - scenario.uav.goal).norm() > 0.2; ++k) {
    const Plan answer = loop.step([&](const HorizonRequest& asked) {
      request = asked;
      TrackSet set = declare_motions(made, kWorldZero, asked.header.utime, asked.header.utime + kAhead);
      now.predictions = std::make_shared<const PredictionProducts>(std::move(set));
      return now;
    });
    const auto problem = problem_of(request, now, answer, config);
    if (!problem) continue;
    ++taken;
    if (!take(*problem)) break;
  }
  return taken;
}

}  // namespace tern::benchmarks
