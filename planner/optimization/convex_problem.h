// Eq. 4 with the planes held fixed: a small convex problem in the free control points.
#pragma once

#include <vector>

#include "core/world/horizon.h"
#include "planner/planner_config.h"

namespace tern {

/// A plane that the vehicle's curve must stay behind during part [u0, u1] of an interval.
struct PlaneConstraint {
  int interval = 0;
  double u0 = 0.0, u1 = 1.0;
  Plane plane;
};

/// What Eq. 4 needs; the free variables are q_3 … q_{n-2}, with q_{n-2} = q_{n-1} = q_n.
struct TrajectoryProblem {
  MotionSample start;
  int intervals = 6;                            ///< J
  double interval_s = 0.2;                      ///< Δt
  Limits limits;                                ///< v_max already reduced to the share that plans may use
  double sphere_radius = 4.0;                   ///< S about the start
  Box centre_box;                               ///< flight box for the centre
  double clearance = 0.0;                       ///< radius of a spherical body, m
  Vec3 goal = Vec3::Zero();                     ///< s_g^temp
  double weight_jerk = 0.0, weight_goal = 1.0;  ///< ω_u, ω_g
  double reach = 1e9;  ///< constraints on position farther than this from x0 are left out, m; the checker sees all
};

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

/// Kept between the optimizer's planes and the vehicle, beyond the radius, m: so that the checker, which refuses what
/// lies within kTouchingTolerance of touching, accepts an iterate that sits on its bound.
inline constexpr double kOptimizerMargin = 5e-6;

/// Builds the problem. Bounds that x0 (the search's result) breaks a little — MINVO points bulge beyond the curve — are
/// widened to x0's own value, so that x0 is always feasible; the checker decides with true extrema. What x0 is far from
/// is left out: each row costs.
ConvexProblem make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                                  const Points& initial_control_points);

/// The free variables of control points (3×(J+3)), and back.
Eigen::VectorXd free_variables(const Points& control_points);
Points control_points_of(const Eigen::VectorXd& x, const TrajectoryProblem& problem);

/// Eq. 4's first term without its weight: Σ_j ‖jerk_j‖².
double jerk_cost(const Points& control_points, double interval_s);

}  // namespace tern
