#include "planner/refinement.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/optimization/barrier_solver.h"
#include "planner/optimization/ipopt_solver.h"
#include "planner/plan_workspace.h"
#include "planner/preference.h"

namespace tern {
namespace {

const std::vector<CertificatePlane>& near_planes(const Attempt& attempt, const TimedSpline& trajectory,
                                                 SeparationCache& swept, PlanTools& tools) {
  std::vector<CertificatePlane>& planes = tools.memory.certificates;
  planes.clear();
  find_planes(swept, trajectory.spline(), attempt.problem.hull_basis, attempt.near.config.optimization.plane_reach_m,
              tools.log.statistics.pairs, planes);
  return planes;
}

PlaneConstraint constraint_of(const CertificatePlane& c) {
  const TimePart part{c.interval, c.part, c.parts};
  return {c.interval, part.u0(), part.u1(), c.plane};
}

const Points& hull_of(SeparationCache& swept, const CertificatePlane& plane) {
  for (const SweptObstacles::Neighbour& neighbour : swept.obstacles().neighbours(plane.interval)) {
    if (swept.obstacles().obstacle(neighbour).id == plane.track)
      return swept.hull(neighbour, {plane.interval, plane.part, plane.parts});
  }
  throw std::logic_error("hull_of: a plane of an obstacle that is not in its interval");
}

/// Solves Eq. 4 for one leaf by either method.
class Refinement {
 public:
  Refinement(const Attempt& attempt, const Candidate& leaf, SeparationCache& swept, PlanTools& tools)
      : attempt_(attempt),
        config_(attempt.near.config.optimization),
        swept_(swept),
        tools_(tools),
        problem_(trajectory_problem(attempt, leaf.trajectory.control_points)),
        hold_required_(std::min(attempt.hold_required_s, leaf.hold_s)),
        stop_([&budget = tools.budget] { return budget.expired(Stage::Optimization); }) {}

  /// Solves the convex problem with fixed planes, makes new planes at its solution, and repeats.
  std::optional<Candidate> alternating(const TimedSpline& from) {
    std::optional<Candidate> best;
    for (int round = 0; round < config_.rounds; ++round) {
      tools_.log.enter(Stage::Optimization);
      if (stop_()) break;
      const ConvexSolution solution = counted(solve_convex(best ? best->trajectory : from));
      if (!solution.found) break;
      auto candidate = certified(solution.x);
      if (!candidate) break;
      best = std::move(candidate);
    }
    return best;
  }

  /// Solves for points and planes together.
  std::optional<Candidate> joint(const TimedSpline& from) {
    tools_.log.enter(Stage::Optimization);
    if (stop_()) return std::nullopt;
    std::optional<Candidate> best;
    const JointProblem joint(problem_, gather_pairs(attempt_, from, swept_, tools_), from.control_points);
    counted(solve_joint(joint, config_.max_iterations, stop_, [&](const FreeVariables& x) {
      auto candidate = certified(x);
      tools_.log.enter(Stage::Optimization);
      if (!candidate) return false;
      best = std::move(candidate);
      return true;
    }));
    return best;
  }

 private:
  ConvexSolution counted(ConvexSolution solution) {
    tools_.log.statistics.solver_iterations += solution.iterations;
    ++tools_.log.statistics.solver_calls;
    return solution;
  }

  ConvexSolution solve_convex(const TimedSpline& from) {
    PlanWorkspace& memory = tools_.memory;
    memory.planes.clear();
    for (const CertificatePlane& c : near_planes(attempt_, from, swept_, tools_)) {
      memory.planes.push_back(constraint_of(c));
    }
    make_convex_problem(problem_, memory.planes, from.control_points, memory.convex);
    const FreeVariables x0 = free_variables(from.control_points);
    if (config_.solver == ConvexSolver::Ipopt) return solve_by_ipopt(memory.convex, x0, config_.max_iterations, stop_);
    return memory.barrier.solve(memory.convex, x0, config_.max_iterations, stop_);
  }

  std::optional<Candidate> certified(const FreeVariables& x) {
    auto candidate = certify(attempt_, control_points_of(x, problem_), PlanOutcome::Optimized, swept_, tools_.log);
    if (!candidate || candidate->hold_s < hold_required_) return std::nullopt;
    return candidate;
  }

  const Attempt& attempt_;
  const OptimizationConfig& config_;
  SeparationCache& swept_;
  PlanTools& tools_;
  TrajectoryProblem problem_;
  double hold_required_;
  StopFunction stop_;
};

/// Optimizes the leaf by the configured method.
/// @return nullopt if the method is SearchOnly, or if no iterate passes the checker and holds as long as required (or
/// as the leaf does)
std::optional<Candidate> optimized(const Attempt& attempt, const Candidate& leaf, SeparationCache& swept,
                                   PlanTools& tools) {
  Refinement refinement(attempt, leaf, swept, tools);
  switch (attempt.near.config.optimization.method) {
    case OptimizationMethod::SearchOnly: return std::nullopt;
    case OptimizationMethod::Alternating: return refinement.alternating(leaf.trajectory);
    case OptimizationMethod::Joint: return refinement.joint(leaf.trajectory);
    case OptimizationMethod::AlternatingThenJoint: break;
  }
  auto first = refinement.alternating(leaf.trajectory);
  auto second = refinement.joint(first ? first->trajectory : leaf.trajectory);
  return second ? second : first;
}

}  // namespace

Candidate refined(const Attempt& attempt, Candidate leaf, SeparationCache& swept, PlanTools& tools) {
  auto smooth = optimized(attempt, leaf, swept, tools);
  return smooth && replaces_leaf(*smooth, leaf, attempt) ? std::move(*smooth) : std::move(leaf);
}

TrajectoryProblem trajectory_problem(const Attempt& attempt, const Points& leaf) {
  const PlannerConfig& config = attempt.near.config;
  TrajectoryProblem problem{attempt.problem};
  problem.weight_jerk = config.optimization.weight_jerk;
  problem.weight_goal = config.optimization.weight_goal;
  problem.reach = config.optimization.plane_reach_m;
  const Vec3 end = leaf.rightCols<1>();
  const bool arrives = attempt.course.cost_to_go.from(end) <= config.search.band_m;
  problem.goal = attempt.course.fields != nullptr && !arrives ? end : attempt.course.local.goal;
  return problem;
}

std::vector<SeparatedPair> gather_pairs(const Attempt& attempt, const TimedSpline& trajectory, SeparationCache& swept,
                                        PlanTools& tools) {
  std::vector<SeparatedPair> pairs;
  for (const CertificatePlane& c : near_planes(attempt, trajectory, swept, tools)) {
    pairs.push_back({constraint_of(c), hull_of(swept, c)});
  }
  return pairs;
}

}  // namespace tern
