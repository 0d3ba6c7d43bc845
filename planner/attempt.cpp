#include "planner/attempt.h"

#include <algorithm>
#include <cmath>

#include "core/wire/message_limits.h"
#include "planner/optimization/trajectory_problem.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/safety/checker.h"
#include "planner/search/semantic_a_star.h"
#include "planner/semantics/semantic_guide.h"

namespace tern {
namespace {

/// Adds the semantic cost to Eq. 2: summed along the path, and expected ahead. The guide must outlive the problem; it
/// is passed by pointer, because a larger function object would allocate.
void add_semantics(const SemanticGuide* guide, SearchProblem& problem) {
  problem.accumulated = [guide](const Vec3& a, const Vec3& b) { return guide->along(a, b); };
  problem.pointwise = [guide](const Vec3& q) { return guide->ahead(q); };
}

/// Returns the terms of the cost that do not depend on the course.
PlanCost cost_of(const Attempt& attempt, const TimedSpline& trajectory) {
  PlanCost cost;
  const Points& q = trajectory.control_points;
  const Vec3 end = q.col(q.cols() - 1);
  const PlannerConfig& config = attempt.near.config;
  cost.jerk = jerk_cost(q, trajectory.interval.seconds());
  if (attempt.course.fields != nullptr) {
    const SemanticFields& fields = *attempt.course.fields;
    if (config.semantic_cost == SemanticCost::MeanDistance) {
      cost.attraction = fields.mean_distance_cost(VoxelLabel::Attractive, end);
      cost.repulsion = fields.mean_distance_cost(VoxelLabel::Repulsive, end);
    } else {
      for (Eigen::Index l = 1; l < q.cols(); ++l) {
        cost.attraction += fields.exposure_cost(VoxelLabel::Attractive, q.col(l - 1), q.col(l));
        cost.repulsion += fields.exposure_cost(VoxelLabel::Repulsive, q.col(l - 1), q.col(l));
      }
    }
  }
  return cost;
}

}  // namespace

void evaluate(const Surroundings& near, const Course& course, Candidate& candidate) {
  candidate.arrival_s = arrival_with_exposure(near, course, candidate.trajectory);
  const OptimizationConfig& weights = near.config.optimization;
  PlanCost& cost = candidate.cost;
  const Vec3& start = near.request.start.p;
  cost.distance_to_goal = (candidate.trajectory.control_points.rightCols<1>() - course.local.goal).norm();
  candidate.progress = progress_share(start, course.local.goal, candidate.trajectory);
  candidate.approaches = cost.distance_to_goal < (course.local.goal - start).norm() - kMinApproach;
  cost.total = weights.weight_jerk * cost.jerk + weights.weight_goal * cost.distance_to_goal * cost.distance_to_goal;
}

void append_hold(std::vector<double>& times, double step, double hold_s) {
  const double end = times.back();
  for (int k = 1; (k - 1) * step < hold_s - 1e-9; ++k) times.push_back(end + std::min(k * step, hold_s));
}

std::optional<Duration> interval_of(double duration_s, int intervals) {
  const double dt = std::max(duration_s / intervals, kMinInterval);
  if (!(dt <= kMaxIntervalDuration.seconds())) return std::nullopt;
  return Duration{static_cast<std::int64_t>(std::ceil(dt * 1e6))};
}

std::optional<Attempt> attempt_of(const Surroundings& near, const Course& course, double duration_s) {
  const std::optional<Duration> interval = interval_of(duration_s, near.config.intervals);
  if (!interval) return std::nullopt;
  const double end_s = interval->seconds() * near.config.intervals;
  const Attempt attempt{near, course, horizon_problem(near, *interval), near.hold.cap(end_s),
                        near.hold.required(end_s)};
  return is_followed(near, *interval, attempt.hold_s) ? std::optional(attempt) : std::nullopt;
}

Vec3 on_smooth_way(const MotionSample& start, const Vec3& stop, double way_s, double share) {
  const double reached = share * share * (3.0 - 2.0 * share), carried = share * (1.0 - share) * (1.0 - share) * way_s;
  return start.p + reached * (stop - start.p) + carried * start.v;
}

SeparationCache& sweep_horizon(const Attempt& attempt, std::vector<double>& times, SweptHorizon& swept) {
  const HorizonProblem& problem = attempt.problem;
  const double dt = problem.interval_s();
  times.clear();
  for (int k = 0; k <= problem.intervals; ++k) times.push_back(k * dt);
  append_hold(times, std::max(dt, kHoldStep), attempt.hold_s);
  const Box region = box_around(problem.start.p, Vec3::Constant(problem.sphere_radius));
  const HorizonRequest& request = attempt.near.request;
  return swept.assign(attempt.near.obstacles, request.body, request.t_s, times, region);
}

std::optional<Candidate> search_candidate(const Attempt& attempt, const SearchConfig& config, SeparationCache& swept,
                                          PlanTools& tools) {
  tools.log.enter(Stage::Search);
  SearchProblem problem{attempt.problem};
  problem.cost_to_go = attempt.course.cost_to_go;
  problem.hold_required_s = attempt.hold_required_s;
  problem.keep_nodes = tools.log.wants_search_nodes();
  std::optional<SemanticGuide> guide;
  if (attempt.course.fields != nullptr) add_semantics(&guide.emplace(guide_of(attempt.near, attempt.course)), problem);
  const SearchResult found = semantic_a_star(problem, config, swept, tools.budget, tools.memory.search);
  tools.log.searched(problem, swept, found);
  tools.log.statistics.expansions += found.expansions;
  tools.log.statistics.pairs += found.pairs;
  if (!found.found) return std::nullopt;
  return certify(attempt, found.control_points, PlanOutcome::SearchOnly, swept, tools.log);
}

std::optional<Candidate> certify(const Attempt& attempt, const Points& control_points, PlanOutcome outcome,
                                 SeparationCache& swept, PlanLog& log) {
  Candidate c;
  c.outcome = outcome;
  c.assurance = attempt.near.assurance;
  c.relaxed = attempt.near.start.relaxed;
  c.trajectory = {attempt.near.request.t_s, attempt.problem.interval, control_points};
  log.enter(Stage::Check);
  CheckReport report = check_plan(c.trajectory, attempt.problem, swept);
  log.statistics.pairs += report.pairs;
  if (!report.ok()) return std::nullopt;
  c.certificate = std::move(report.certificate);
  const Vec3 end = control_points.col(control_points.cols() - 1);
  PairCounts pairs;
  c.hold_s = clear_time_at(swept, attempt.problem.intervals, end, pairs).seconds;
  c.holds = lasts(c.hold_s, attempt.hold_required_s);
  c.clear_s = attempt.problem.interval_s() * attempt.problem.intervals + c.hold_s;
  c.contact_s = contact_time(attempt.near, c.trajectory);
  c.cost = cost_of(attempt, c.trajectory);
  evaluate(attempt.near, attempt.course, c);
  return c;
}

}  // namespace tern
