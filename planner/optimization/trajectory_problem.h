// Eq. 4's data, and the points of the curve that its constraints speak of, as functions of the free control points.
#pragma once

#include <algorithm>
#include <array>

#include "core/geometry/separation.h"
#include "planner/problem/horizon_problem.h"
#include "planner/problem/planner_config.h"

namespace tern {

/// A plane that the vehicle's curve must stay behind during part [u0, u1] of an interval.
struct PlaneConstraint {
  int interval = 0;
  double u0 = 0.0, u1 = 1.0;
  Plane plane;
};

/// What Eq. 4 needs besides, with plan_limits; the free variables are q_3 … q_{n-2}, with q_{n-2} = q_{n-1} = q_n.
struct TrajectoryProblem : HorizonProblem {
  Vec3 goal = Vec3::Zero();                     ///< s_g^temp
  double weight_jerk = 0.0, weight_goal = 1.0;  ///< ω_u, ω_g
  double reach = 1e9;  ///< constraints on position farther than this from x0 are left out, m; the checker sees all
};

/// Kept between the optimizer's planes and the vehicle, beyond the radius, m. The checker refuses what lies within
/// kTouchingTolerance of touching, and shall accept an iterate that lies on its bound.
inline constexpr double kOptimizerMargin = 5e-6;

/// How far beyond its plane the curve must stay: at −this or less.
inline double plane_margin(const HorizonProblem& problem) {
  return std::max(problem.clearance, kPlaneMargin) + kOptimizerMargin;
}

/// A number per free control point, and one per coordinate of each: x, y, z of q_3, then q_4 … They hold no heap.
using FreeWeights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxPlanIntervals - 2, 1>;
using FreeVariables = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * (kMaxPlanIntervals - 2), 1>;

/// A point that is affine in the free control points: Σ_i weight_i q_{3+i} + offset, on each axis alike.
struct AffinePoint {
  FreeWeights weights;  ///< J − 2
  Vec3 offset = Vec3::Zero();

  [[nodiscard]] bool fixed() const { return weights.cwiseAbs().maxCoeff() < 1e-12; }  ///< the start decides it alone
  [[nodiscard]] Vec3 at(const FreeVariables& x) const;
};

/// Hull points and control points of the curve and its derivatives as affine points.
class CurvePoints {
 public:
  /// @param problem  kept by reference. @throws std::invalid_argument unless 4 ≤ J ≤ kMaxPlanIntervals.
  explicit CurvePoints(const HorizonProblem& problem);

  [[nodiscard]] int free_points() const { return free_; }  ///< J − 2
  /// Σ_k c_k q_{j+k}: a combination of the four control points of interval j.
  [[nodiscard]] AffinePoint combination(int j, const Eigen::Vector4d& c) const;
  /// MINVO points of interval j: S and the flight box are kept by these, as the checker asks.
  [[nodiscard]] std::array<AffinePoint, 4> minvo(int j) const;
  /// The points of the problem's hull basis for the part [u0, u1] of interval j.
  [[nodiscard]] std::array<AffinePoint, 4> hull(int j, double u0, double u1) const;
  /// The points whose hull holds the velocity of interval j, m/s.
  [[nodiscard]] std::array<AffinePoint, 3> velocity_hull(int j) const;
  /// v_l = (q_{l+1} − q_l)/Δt for l ≥ 2, m/s.
  [[nodiscard]] AffinePoint velocity_control_point(int l) const;
  [[nodiscard]] AffinePoint acceleration_at_end(int j) const;  ///< of interval j, m/s²
  [[nodiscard]] AffinePoint jerk(int j) const;                 ///< m/s³

 private:
  const HorizonProblem& problem_;
  const SplineBasis& basis_;
  int free_;
  Points3 start_;
};

/// The free variables of control points (3×(J+3)), and back.
FreeVariables free_variables(const Points& control_points);
Points control_points_of(const FreeVariables& x, const HorizonProblem& problem);

/// Eq. 4's first term without its weight: Σ_j ‖jerk_j‖².
double jerk_cost(const Points& control_points, double interval_s);

}  // namespace tern
