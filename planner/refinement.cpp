#include "planner/refinement.h"

#include <algorithm>
#include <stdexcept>

#include "planner/optimization/barrier_solver.h"
#include "planner/optimization/ipopt_solver.h"

namespace tern {
namespace {

const std::vector<CertificatePlane>& near_planes(const AttemptContext& context, SweptObstacles& obstacles,
                                                 const TimedSpline& trajectory) {
  const ClampedSpline spline = trajectory.spline();
  std::vector<CertificatePlane>& planes = context.workspace.certificates;
  planes.clear();
  PairCounts counts;
  for (int j = 0; j < spline.intervals(); ++j) {
    separate_interval(obstacles, j, spline.power(j), counts, &planes, context.config.optimization.plane_reach_m,
                      {context.config.hull_basis, spline.intervals()});
  }
  context.statistics.pairs += counts;
  return planes;
}

PlaneConstraint constraint_of(const CertificatePlane& c) {
  const double parts = c.parts;
  return {c.interval, c.part / parts, (c.part + 1) / parts, c.plane};
}

const Points& hull_of(SweptObstacles& obstacles, const CertificatePlane& plane) {
  for (const SweptObstacles::Candidate& candidate : obstacles.candidates(plane.interval)) {
    if (obstacles.obstacle(candidate).id == plane.track)
      return obstacles.hull(plane.interval, candidate, plane.part, plane.parts);
  }
  throw std::logic_error("hull_of: a plane of an obstacle that is not in its interval");
}

class Refinement {
 public:
  Refinement(const AttemptContext& context, SweptObstacles& obstacles, const Candidate& searched)
      : context_(context),
        config_(context.config.optimization),
        obstacles_(obstacles),
        problem_(trajectory_problem(context, searched.trajectory)),
        required_(context.hold.required(searched.clear_s - searched.hold_s)),
        hold_required_(std::min(required_, searched.hold_s)),
        stop_([&budget = context.budget] { return budget.expired(Stage::Optimization); }) {}

  /// With the planes fixed the problem is convex; the planes anew at its solution, and again.
  std::optional<Candidate> alternating(const TimedSpline& from) {
    std::optional<Candidate> best;
    TimedSpline current = from;
    for (int round = 0; round < config_.rounds; ++round) {
      enter_stage();
      if (stop_()) break;
      const ConvexSolution solution = solve_convex(current);
      context_.statistics.solver_iterations += solution.iterations;
      ++context_.statistics.solver_calls;
      if (!solution.found) break;
      auto candidate = certified(current.interval, solution.x);
      if (!candidate) break;
      current = candidate->trajectory;
      best = std::move(candidate);
    }
    return best;
  }

  /// Points and planes together.
  std::optional<Candidate> joint(const TimedSpline& from) {
    enter_stage();
    if (stop_()) return std::nullopt;
    std::optional<Candidate> best;
    const JointProblem joint(problem_, gather_pairs(context_, obstacles_, from), from.control_points);
    const ConvexSolution solution = solve_joint(joint, config_.max_iterations, stop_, [&](const FreeVariables& x) {
      auto candidate = certified(from.interval, x);
      enter_stage();
      if (!candidate) return false;
      best = std::move(candidate);
      return true;
    });
    context_.statistics.solver_iterations += solution.iterations;
    ++context_.statistics.solver_calls;
    return best;
  }

 private:
  void enter_stage() {
    if (context_.observer != nullptr) context_.observer->enter(Stage::Optimization);
  }

  ConvexSolution solve_convex(const TimedSpline& from) {
    PlanWorkspace& memory = context_.workspace;
    memory.planes.clear();
    for (const CertificatePlane& c : near_planes(context_, obstacles_, from)) memory.planes.push_back(constraint_of(c));
    make_convex_problem(problem_, memory.planes, from.control_points, memory.convex);
    const FreeVariables x0 = free_variables(from.control_points);
    if (config_.solver == ConvexSolver::Ipopt) return solve_by_ipopt(memory.convex, x0, config_.max_iterations, stop_);
    return memory.barrier.solve(memory.convex, x0, config_.max_iterations, stop_);
  }

  std::optional<Candidate> certified(Duration interval, const FreeVariables& x) {
    auto candidate =
        certify(context_, obstacles_, interval, control_points_of(x, problem_), PlanOutcome::Optimized, required_);
    if (!candidate || candidate->hold_s < hold_required_) return std::nullopt;
    return candidate;
  }

  const AttemptContext& context_;
  const OptimizationConfig& config_;
  SweptObstacles& obstacles_;
  TrajectoryProblem problem_;
  double required_;  // to count as holding
  double hold_required_;
  StopFunction stop_;
};

}  // namespace

std::optional<Candidate> refine(const AttemptContext& context, SweptObstacles& obstacles, const Candidate& searched) {
  Refinement refinement(context, obstacles, searched);
  switch (context.config.optimization.method) {
    case OptimizationMethod::SearchOnly: return std::nullopt;
    case OptimizationMethod::Alternating: return refinement.alternating(searched.trajectory);
    case OptimizationMethod::Joint: return refinement.joint(searched.trajectory);
    case OptimizationMethod::AlternatingThenJoint: break;
  }
  auto first = refinement.alternating(searched.trajectory);
  auto second = refinement.joint(first ? first->trajectory : searched.trajectory);
  return second ? second : first;
}

TrajectoryProblem trajectory_problem(const AttemptContext& context, const TimedSpline& searched) {
  const OptimizationConfig& config = context.config.optimization;
  TrajectoryProblem problem;
  problem.start = context.request.start;
  problem.intervals = context.config.intervals;
  problem.interval_s = searched.interval.seconds();
  problem.limits = context.plan_limits;
  problem.sphere_radius = context.config.sphere_radius_m;
  problem.centre_box = centre_box(context.request.flight_box, context.request.body);
  problem.clearance = context.request.body.radius;
  problem.weight_jerk = config.weight_jerk;
  problem.weight_goal = config.weight_goal;
  problem.reach = config.plane_reach_m;
  problem.hull_basis = context.config.hull_basis;
  const Points& leaf = searched.control_points;
  const Vec3 end = leaf.col(leaf.cols() - 1);
  const bool arrives = context.way.from(end) <= context.config.search.band_m;
  problem.goal = context.fields != nullptr && !arrives ? end : context.local_goal;
  return problem;
}

std::vector<SeparatedPair> gather_pairs(const AttemptContext& context, SweptObstacles& obstacles,
                                        const TimedSpline& trajectory) {
  std::vector<SeparatedPair> pairs;
  for (const CertificatePlane& c : near_planes(context, obstacles, trajectory)) {
    pairs.push_back({constraint_of(c), hull_of(obstacles, c)});
  }
  return pairs;
}

}  // namespace tern
