// Eq. 4 with the planes held fixed: a small convex problem in the free control points.
#pragma once

#include <vector>

#include "planner/optimization/trajectory_problem.h"

namespace tern {

/// min ½ xᵀH x + gᵀx + c   subject to   A x ≤ b   and   ‖W_k x + p_k‖² ≤ r² for each sphere point k.
///
/// x stacks the free control points (x, y, z of q_3, then q_4 …), 3(J − 2) numbers.
struct ConvexProblem {
  Eigen::MatrixXd hessian;         ///< H, symmetric positive definite
  Eigen::VectorXd gradient;        ///< g
  double constant = 0.0;           ///< c
  Eigen::MatrixXd rows;            ///< A, a constraint per row
  Eigen::VectorXd bounds;          ///< b
  Eigen::MatrixXd sphere_weights;  ///< one row per point: the scalar weight of each free control point
  Points sphere_offsets;           ///< p_k, relative to the sphere's centre, one per column
  double sphere_radius2 = 0.0;     ///< r²

  [[nodiscard]] int variables() const { return static_cast<int>(gradient.size()); }
  [[nodiscard]] int spheres() const { return static_cast<int>(sphere_offsets.cols()); }
  [[nodiscard]] double objective(const Eigen::VectorXd& x) const {
    return 0.5 * x.dot(hessian * x) + gradient.dot(x) + constant;
  }
  /// W_k x + p_k.
  [[nodiscard]] Vec3 sphere_point(int k, const Eigen::VectorXd& x) const;
  /// The largest violation of any constraint (rows: as they stand; spheres: in m²), ≤ 0 when x is feasible.
  [[nodiscard]] double worst_violation(const Eigen::VectorXd& x) const;
};

/// Room that x0 has to every bound, in the bound's unit (m, m/s, m/s², m/s³, m²): a leaf that lies on opposite bounds
/// would leave no interior, and an interior point method no way (of 10,000 recorded problems, one). A tenth of the
/// checker's tolerance (kLimitTolerance) for limits of 1, less for larger ones; what a smaller limit refuses, the
/// checker refuses.
inline constexpr double kStartRoom = 1e-7;

/// Builds the problem. Bounds that x0 (the search's result) breaks a little — MINVO points bulge beyond the curve — are
/// widened to x0's own value, so that x0 is always strictly feasible (by kStartRoom); the checker decides with true
/// extrema. What x0 is far from is left out: each row costs.
ConvexProblem make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                                  const Points& initial_control_points);

}  // namespace tern
