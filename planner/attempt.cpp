#include "planner/attempt.h"

#include <algorithm>
#include <cmath>

#include "core/world/message_limits.h"
#include "planner/duration.h"
#include "planner/optimization/trajectory_problem.h"
#include "planner/semantics/semantic_guide.h"

namespace tern {
namespace {

/// For how long a trajectory is taken to be flown before a better one follows, s; where a step takes minutes, this
/// share of it: nothing better follows within a second.
struct While {
  double least_s;
  double share;
  [[nodiscard]] double of(double step_s) const { return std::max(least_s, share * step_s); }
};
constexpr While kWhiles[] = {{0.3, 0.15}, {0.8, 0.4}};

constexpr double kLeastInterval = 0.02;  // s

SemanticGuide guide_of(const AttemptContext& context) {
  return {*context.fields, context.config.semantic_cost, context.request.start.p, context.local_goal};
}

/// Semantics enter Eq. 2 summed along the path and by what is expected of the rest. The guide must outlive the problem
/// (by pointer: a function that holds more allocates).
void add_semantics(const SemanticGuide* guide, SearchProblem& problem) {
  problem.accumulated = [guide](const Vec3& a, const Vec3& b) { return guide->along(a, b); };
  problem.pointwise = [guide](const Vec3& q) { return guide->ahead(q); };
}

CheckDemands demands_of(const AttemptContext& context) {
  return {context.request.start, context.request.limits, context.request.flight_box, context.config.sphere_radius_m};
}

PlanCost cost_of(const AttemptContext& context, const TimedSpline& trajectory) {
  PlanCost cost;
  const Points& q = trajectory.control_points;
  const Vec3 end = q.col(q.cols() - 1);
  cost.distance_to_goal = (end - context.local_goal).norm();
  cost.jerk = jerk_cost(q, trajectory.interval.seconds());
  if (context.fields != nullptr) {
    const SemanticFields& fields = *context.fields;
    if (context.config.semantic_cost == SemanticCost::MeanDistance) {
      cost.attraction = fields.mean_distance_cost(VoxelLabel::Attractive, end);
      cost.repulsion = fields.mean_distance_cost(VoxelLabel::Repulsive, end);
    } else {
      for (Eigen::Index l = 1; l < q.cols(); ++l) {
        cost.attraction += fields.exposure_cost(VoxelLabel::Attractive, q.col(l - 1), q.col(l));
        cost.repulsion += fields.exposure_cost(VoxelLabel::Repulsive, q.col(l - 1), q.col(l));
      }
    }
  }
  const OptimizationConfig& w = context.config.optimization;
  cost.total = w.weight_jerk * cost.jerk + w.weight_goal * cost.distance_to_goal * cost.distance_to_goal;
  return cost;
}

}  // namespace

std::optional<Candidate> certify(const AttemptContext& context, SweptObstacles& obstacles, Duration interval,
                                 const Points& control_points, PlanOutcome outcome, double hold_required_s) {
  Candidate c;
  c.outcome = outcome;
  c.trajectory = {context.request.t_s, interval, control_points};
  if (context.observer != nullptr) context.observer->enter(Stage::Check);
  CheckReport report = check_plan(c.trajectory, demands_of(context), obstacles);
  context.statistics.pairs += report.pairs;
  if (!report.ok()) return std::nullopt;
  c.certificate = std::move(report.certificate);
  const int intervals = static_cast<int>(control_points.cols()) - 3;
  const Vec3 end = control_points.col(control_points.cols() - 1);
  PairCounts pairs;
  c.hold_s = clear_time_at(obstacles, intervals, end, pairs).seconds;
  c.holds = lasts(c.hold_s, hold_required_s);
  const double duration_s = interval.seconds() * intervals;
  c.clear_s = duration_s + c.hold_s;
  c.arrival_s = worth_of(context, c.trajectory);
  c.cost = cost_of(context, c.trajectory);
  return c;
}

double arrival_estimate(const WayToGo& way, const TimedSpline& trajectory, UTime from, const Limits& limits,
                        double step_s) {
  const ClampedSpline spline = trajectory.spline();
  const double offset_s = (from - trajectory.start).seconds();
  double sum = 0.0;
  for (const While& shall : kWhiles) {
    const double while_s = shall.of(step_s);
    const MotionSample at = spline.sample(offset_s + while_s);
    sum += while_s + least_duration(at, way.point, limits) + way.rest / limits.v_max.minCoeff();
  }
  return 0.5 * sum;
}

double worth_of(const AttemptContext& context, const TimedSpline& trajectory) {
  const UTime from = context.request.t_s;
  const double arrival_s = arrival_estimate(context.way, trajectory, from, context.pace, context.step_s);
  if (context.fields == nullptr || context.config.semantic_cost == SemanticCost::MeanDistance) return arrival_s;
  const SemanticGuide guide = guide_of(context);
  const ClampedSpline spline = trajectory.spline();
  double metres = 0.0;
  for (const While& shall : kWhiles) {
    metres += 0.5 * guide.of(spline, (from - trajectory.start).seconds(), shall.of(context.step_s));
  }
  return arrival_s + metres / context.plan_limits.v_max.minCoeff();
}

void append_hold(std::vector<double>& times, double step, double hold_s) {
  const double end = times.back();
  for (int k = 1; (k - 1) * step < hold_s - 1e-9; ++k) times.push_back(end + std::min(k * step, hold_s));
}

std::optional<Duration> interval_of(double duration_s, int intervals) {
  const double dt = std::max(duration_s / intervals, kLeastInterval);
  if (!(dt <= kLongestInterval.seconds())) return std::nullopt;
  return Duration{static_cast<std::int64_t>(std::ceil(dt * 1e6))};
}

bool is_followed(const AttemptContext& context, Duration interval, double hold_s) {
  const Duration looks = interval * context.config.intervals + Duration::from_seconds(hold_s);
  return context.request.t_s + looks <= context.look.followed_until;
}

void sweep_horizon(const AttemptContext& context, Duration interval, double hold_s, SweptObstacles& swept) {
  const double dt = interval.seconds();
  std::vector<double>& times = context.workspace.times;
  times.clear();
  for (int k = 0; k <= context.config.intervals; ++k) times.push_back(k * dt);
  append_hold(times, std::max(dt, kHoldStep), hold_s);
  const Box region = box_around(context.request.start.p, Vec3::Constant(context.config.sphere_radius_m));
  swept.assign(context.obstacles, context.request.body, context.request.t_s, times, region);
}

std::optional<Candidate> search_candidate(const AttemptContext& context, SweptObstacles& obstacles, Duration interval,
                                          double hold_required_s, const SearchConfig& config) {
  if (context.observer != nullptr) context.observer->enter(Stage::Search);
  SearchProblem problem;
  problem.start = context.request.start;
  problem.intervals = context.config.intervals;
  problem.interval_s = interval.seconds();
  problem.limits = context.plan_limits;
  problem.true_v_max = context.request.limits.v_max;
  problem.sphere_centre = context.request.start.p;
  problem.sphere_radius = context.config.sphere_radius_m;
  problem.centre_box = centre_box(context.request.flight_box, context.request.body);
  problem.way = context.way;
  problem.hold_required_s = hold_required_s;
  problem.keep_nodes = context.observer != nullptr && context.observer->wants_search_nodes();
  problem.hull_basis = context.config.hull_basis;
  std::optional<SemanticGuide> guide;
  if (context.fields != nullptr) add_semantics(&guide.emplace(guide_of(context)), problem);
  const SearchResult found = semantic_a_star(problem, config, obstacles, context.budget, context.workspace.search);
  if (context.observer != nullptr) context.observer->searched(problem, obstacles, found);
  context.statistics.expansions += found.expansions;
  context.statistics.pairs += found.pairs;
  if (!found.found) return std::nullopt;
  return certify(context, obstacles, interval, found.control_points, PlanOutcome::SearchOnly, hold_required_s);
}

}  // namespace tern
