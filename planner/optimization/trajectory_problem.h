// The data of Eq. 4, and the curve's points in its constraints as functions of the free control points. See
// docs/planner/optimization.md.
#pragma once

#include <algorithm>
#include <array>

#include "core/geometry/separation.h"
#include "planner/problem/horizon_problem.h"
#include "planner/problem/planner_config.h"

namespace tern {

/// A plane that the curve must stay behind during the part [u0, u1] of an interval.
struct PlaneConstraint {
  int interval = 0;
  double u0 = 0.0, u1 = 1.0;
  Plane plane;
};

/// The data of Eq. 4, within plan_limits. The free variables are q_3 … q_{n-2}, with q_{n-2} = q_{n-1} = q_n.
struct TrajectoryProblem : HorizonProblem {
  Vec3 goal = Vec3::Zero();                     ///< s_g^temp
  double weight_jerk = 0.0, weight_goal = 1.0;  ///< ω_u, ω_g
  double reach = 1e9;  ///< constraints on position farther than this from x0 are left out, m; the checker tests all
};

/// Distance between the optimizer's planes and the vehicle, beyond the radius, m. The checker rejects curves within
/// kTouchingTolerance of touching, and must accept an iterate that lies on its bound.
inline constexpr double kOptimizerMargin = 5e-6;

/// Returns the margin of a plane: the curve must keep n·q + d ≤ −margin.
inline double plane_margin(const HorizonProblem& problem) {
  return std::max(problem.clearance, kPlaneMargin) + kOptimizerMargin;
}

/// FreeWeights has a number per free control point, FreeVariables one per coordinate: x, y, z of q_3, then of q_4 …
/// Neither uses the heap.
using FreeWeights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxPlanIntervals - 2, 1>;
using FreeVariables = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * (kMaxPlanIntervals - 2), 1>;

/// A point that is affine in the free control points: Σ_i weight_i q_{3+i} + offset, with the same weights on each
/// axis.
struct AffinePoint {
  FreeWeights weights;  ///< J − 2
  Vec3 offset = Vec3::Zero();

  [[nodiscard]] bool fixed() const { return weights.cwiseAbs().maxCoeff() < 1e-12; }  ///< it depends on the start alone
  [[nodiscard]] Vec3 at(const FreeVariables& x) const;
};

/// Hull points and control points of the curve and its derivatives, as affine points.
class CurvePoints {
 public:
  /// @param problem  must outlive this object. @throws std::invalid_argument unless 4 ≤ J ≤ kMaxPlanIntervals
  explicit CurvePoints(const HorizonProblem& problem);

  [[nodiscard]] int free_points() const { return free_; }  ///< J − 2
  /// Returns Σ_k c_k q_{j+k}, a combination of the four control points of interval j.
  [[nodiscard]] AffinePoint combination(int j, const Eigen::Vector4d& c) const;
  /// Returns the MINVO points of interval j. S and the flight box are constraints on these, as in the checker.
  [[nodiscard]] std::array<AffinePoint, 4> minvo(int j) const;
  /// Returns the points of the problem's hull basis for the part [u0, u1] of interval j.
  [[nodiscard]] std::array<AffinePoint, 4> hull(int j, double u0, double u1) const;
  /// Returns points whose hull contains the velocity of interval j, m/s.
  [[nodiscard]] std::array<AffinePoint, 3> velocity_hull(int j) const;
  /// Returns v_l = (q_{l+1} − q_l)/Δt for l ≥ 2, m/s.
  [[nodiscard]] AffinePoint velocity_control_point(int l) const;
  [[nodiscard]] AffinePoint acceleration_at_end(int j) const;  ///< of interval j, m/s²
  [[nodiscard]] AffinePoint jerk(int j) const;                 ///< m/s³

 private:
  const HorizonProblem& problem_;
  const SplineBasis& basis_;
  int free_;
  Points3 start_;
};

/// Convert control points (3×(J+3)) to the free variables, and back.
FreeVariables free_variables(const Points& control_points);
Points control_points_of(const FreeVariables& x, const HorizonProblem& problem);

/// Returns the first term of Eq. 4 without its weight: Σ_j ‖jerk_j‖², m²/s⁶.
double jerk_cost(const Points& control_points, double interval_s);

}  // namespace tern
