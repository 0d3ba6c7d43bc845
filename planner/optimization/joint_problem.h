// Eq. 4 as the paper writes it: control points and planes are variables together.
#pragma once

#include <array>

#include "planner/optimization/convex_solution.h"
#include "planner/optimization/nonlinear_problem.h"
#include "planner/optimization/trajectory_problem.h"

namespace tern {

/// An obstacle and the part of an interval that it must be separated from.
struct SeparatedPair {
  PlaneConstraint plane;  ///< a plane that separates them now: where the search begins
  Points hull;            ///< vertices of C_ij over that part, W
};

/// Over x (free control points) and, per pair, a plane (n, d):
///
///     min ω_u Σ ‖jerk_j‖² + ω_g ‖q_{n-2} − s_g^temp‖²
///     n·c + d ≥ 0 for the hull's vertices c,   n·q(x) + d ≤ −margin for the curve's hull points q,   |n|² ≤ 1
///
/// and the limits, boxes and spheres of make_convex_problem. It is |n|² ≤ 1 and not = 1, because an interior point
/// method needs an interior. A shorter n only asks for more: n·q + d ≤ −margin is a distance of margin/|n|. Positions
/// count from the start, so that d stays small. The products n·q make it non-convex: what is found is a local optimum
/// that depends on where it begins.
///
/// Variables: 3(J − 2) of x, then n and d of each pair.
class JointProblem final : public NonlinearProblem {
 public:
  /// Bounds that the initial control points break a little are widened as make_convex_problem does.
  JointProblem(const TrajectoryProblem& problem, const std::vector<SeparatedPair>& pairs,
               const Points& initial_control_points);

  JointProblem(const JointProblem&) = delete;
  JointProblem& operator=(const JointProblem&) = delete;

  [[nodiscard]] Eigen::VectorXd start() const { return start_; }  ///< initial points and planes
  [[nodiscard]] int free_variables() const { return convex_.variables(); }

  [[nodiscard]] int variables() const override { return static_cast<int>(start_.size()); }
  [[nodiscard]] double objective(const Eigen::VectorXd& x) const override;
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& x) const override;
  [[nodiscard]] Eigen::VectorXd constraints(const Eigen::VectorXd& x) const override;
  void jacobian(const Eigen::VectorXd& x, double* values) const override;
  void hessian(const Eigen::VectorXd& x, double factor, const double* multipliers, double* values) const override;

 private:
  /// What one pair adds. Its constraints: a row per vertex, four for the curve, one for |n|.
  struct Block {
    int variable;                      ///< of n_x; n_y, n_z and d follow
    int first_point, free_points;      ///< the curve's hull points depend on these free control points alone
    Points vertices;                   ///< from the start
    std::array<AffinePoint, 4> curve;  ///< from the start
  };
  void add_block(const TrajectoryProblem& problem, const CurvePoints& points, const SeparatedPair& pair);
  void add_patterns();

  ConvexProblem convex_;
  ConvexAsNonlinear base_;
  std::vector<Block> blocks_;
  double margin_;
  Eigen::VectorXd start_;
};

/// Ipopt keeps non-linear constraints to its own tolerance only; the checker decides.
inline constexpr double kJointTolerance = 1e-6;

/// Decides over a feasible point that is better than all before: true keeps it.
using Certify = std::function<bool(const FreeVariables& x)>;

/// By Ipopt. Every point that it evaluates is offered to `certify` if it keeps all constraints to kJointTolerance and
/// costs less than the best kept so far. So the solve can be ended at any time. x: the free control points alone.
/// @param stop  asked once per iteration
ConvexSolution solve_joint(const JointProblem& problem, int max_iterations, const StopFunction& stop,
                           const Certify& certify);

}  // namespace tern
