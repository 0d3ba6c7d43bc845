// Eq. 4 as the paper writes it: control points and planes are variables together. See docs/planner/optimization.md.
#pragma once

#include <array>

#include "planner/optimization/convex_solution.h"
#include "planner/optimization/nonlinear_problem.h"
#include "planner/optimization/trajectory_problem.h"

namespace tern {

/// An obstacle and the part of an interval that it must be separated from.
struct SeparatedPair {
  PlaneConstraint plane;  ///< a separating plane, from which the solver starts
  Points hull;            ///< vertices of C_ij over that part, W
};

/// Minimises over x (free control points) and, per pair, a plane (n, d):
///
///     min ω_u Σ ‖jerk_j‖² + ω_g ‖q_{n-2} − s_g^temp‖²
///     n·c + d ≥ 0 for the hull's vertices c,   n·q(x) + d ≤ −margin for the curve's hull points q,   |n|² ≤ 1
///
/// subject to the limits, boxes and spheres of make_convex_problem(). Positions are relative to the start, so that d
/// stays small. The variables are the 3(J − 2) of x, then n and d of each pair.
///
/// The constraint is |n|² ≤ 1 instead of = 1, because an interior point method needs an interior. A shorter n is only
/// stricter: n·q + d ≤ −margin is a distance of margin/|n|. The products n·q make the problem non-convex. The result is
/// a local optimum that depends on the initial point.
class JointProblem final : public NonlinearProblem {
 public:
  /// Widens bounds that the initial control points break slightly, as make_convex_problem() does.
  JointProblem(const TrajectoryProblem& problem, const std::vector<SeparatedPair>& pairs,
               const Points& initial_control_points);

  JointProblem(const JointProblem&) = delete;
  JointProblem& operator=(const JointProblem&) = delete;

  [[nodiscard]] Eigen::VectorXd start() const { return start_; }  ///< the initial points and planes
  [[nodiscard]] int free_variables() const { return convex_.variables(); }

  [[nodiscard]] int variables() const override { return static_cast<int>(start_.size()); }
  [[nodiscard]] double objective(const Eigen::VectorXd& x) const override;
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& x) const override;
  [[nodiscard]] Eigen::VectorXd constraints(const Eigen::VectorXd& x) const override;
  void jacobian(const Eigen::VectorXd& x, double* values) const override;
  void hessian(const Eigen::VectorXd& x, double factor, const double* multipliers, double* values) const override;

 private:
  /// The block of one pair. Its constraints: one per vertex, four for the curve, one for |n|.
  struct Block {
    int variable;                      ///< index of n_x; n_y, n_z and d follow
    int first_point, free_points;      ///< range of the free control points that the curve depends on
    Points vertices;                   ///< relative to the start, m
    std::array<AffinePoint, 4> curve;  ///< relative to the start, m
  };
  void add_block(const TrajectoryProblem& problem, const CurvePoints& points, const SeparatedPair& pair);
  void add_patterns();

  ConvexProblem convex_;
  ConvexAsNonlinear base_;
  std::vector<Block> blocks_;
  double margin_;
  Eigen::VectorXd start_;
};

/// Tolerance of the constraints: Ipopt keeps non-linear ones only to its own. The checker decides.
inline constexpr double kJointTolerance = 1e-6;

/// Called with a feasible point that is better than all earlier ones; true keeps it.
using Certify = std::function<bool(const FreeVariables& x)>;

/// Solves by Ipopt. Every evaluated point that keeps all constraints to kJointTolerance and costs less than the best
/// one so far is passed to `certify`. So the solve can be stopped at any time. The solution's x holds the free control
/// points alone.
/// @param stop  called once per iteration
ConvexSolution solve_joint(const JointProblem& problem, int max_iterations, const StopFunction& stop,
                           const Certify& certify);

}  // namespace tern
