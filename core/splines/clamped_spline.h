// The form of a trajectory (paper §2): a clamped uniform cubic B-spline with J intervals of one length Δt. Symbols and
// matrices: docs/reference/notation.md.
#pragma once

#include <memory>

#include "core/base/types.h"
#include "core/splines/minvo.h"

namespace tern {

/// The largest number J of intervals; the smallest is 1. Planning uses J ≥ 4, where no interval is affected by the
/// clamped knots of both ends.
inline constexpr int kMaxIntervals = 128;

/// The matrices of a spline that depend on J alone.
///
/// Knots, in units of Δt: τ_i = clamp(i − 3, 0, J), i = 0 … J + 6. Interval j ∈ [0, J) has the parameter u = τ − j ∈
/// [0, 1] and the control points q_j … q_{j+3} of all J + 3. Q_j is the 3×4 matrix of these four; then
///
///     power coefficients      Q_j · power(j)
///     MINVO points            Q_j · position_minvo(j) = Q_j · power(j) · A⁻¹
///     MINVO points of dP/du   Q_j · velocity_minvo(j); divide by Δt for m/s
///
/// power(j) comes from the Cox–de Boor recursion on the knots, with 0/0 = 0:
///
///     N_{i,k} = (τ − τ_i)/(τ_{i+k} − τ_i) N_{i,k−1} + (τ_{i+k+1} − τ)/(τ_{i+k+1} − τ_{i+1}) N_{i+1,k−1}
///
/// The first two and the last two intervals have matrices of their own. Accessors throw std::out_of_range unless 0 ≤ j
/// < J, allocate nothing and take a few ns.
class SplineBasis {
 public:
  /// @throws std::invalid_argument unless 1 ≤ intervals ≤ kMaxIntervals
  explicit SplineBasis(int intervals);

  [[nodiscard]] int intervals() const { return intervals_; }
  [[nodiscard]] int control_points() const { return intervals_ + 3; }
  [[nodiscard]] const Eigen::Matrix4d& power(int j) const;                       ///< 4×4: B-spline → u³ u² u 1
  [[nodiscard]] const Eigen::Matrix4d& position_minvo(int j) const;              ///< 4×4: B-spline → MINVO
  [[nodiscard]] const Eigen::Matrix<double, 4, 3>& velocity_minvo(int j) const;  ///< 4×3: B-spline → MINVO of dP/du
  [[nodiscard]] const Eigen::Matrix<double, 4, 3>& velocity_bezier(int j) const;  ///< 4×3: B-spline → Bézier of dP/du
  [[nodiscard]] const Eigen::Matrix<double, 4, 2>& acceleration_ends(int j) const;  ///< 4×2: d²P/du² at u = 0, u = 1
  [[nodiscard]] const Eigen::Vector4d& jerk(int j) const;                           ///< 4×1: d³P/du³, constant

 private:
  int intervals_;
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

/// Returns the basis of J intervals that the process shares. It is made at the first call and never freed. Any thread
/// may call this. @throws std::invalid_argument unless 1 ≤ J ≤ kMaxIntervals
const SplineBasis& spline_basis(int intervals);

/// The motion of a point at one instant, in W.
struct MotionSample {
  Vec3 p = Vec3::Zero();  ///< m
  Vec3 v = Vec3::Zero();  ///< m/s
  Vec3 a = Vec3::Zero();  ///< m/s²
  Vec3 j = Vec3::Zero();  ///< m/s³
};

/// A clamped uniform cubic B-spline in W. Time counts in seconds from its own start.
///
/// After its end the spline rests at its last point; this is meaningful only if it ends at rest. Interval indices
/// outside [0, J) throw std::out_of_range. Member functions do not allocate. Derivatives are computed from differences
/// of control points: they keep their digits far from the origin, and equal control points give exact zeros.
class ClampedSpline {
 public:
  /// @param control_points  3×(J+3), 1 ≤ J ≤ kMaxIntervals, finite, m
  /// @param interval_s      Δt > 0, finite, s
  /// @throws std::invalid_argument if an argument is outside its range
  ClampedSpline(Points control_points, double interval_s);

  [[nodiscard]] int intervals() const { return basis_->intervals(); }
  [[nodiscard]] double interval_s() const { return interval_s_; }
  [[nodiscard]] double duration_s() const { return interval_s_ * intervals(); }
  [[nodiscard]] const Points& control_points() const { return control_points_; }
  [[nodiscard]] const SplineBasis& basis() const { return *basis_; }

  /// Returns the motion at t_s ≥ 0. Jerk at an inner knot is that of the later interval; at duration_s() it is that of
  /// the last one. After the end p = q_n, and v, a, j are zero.
  /// @throws std::invalid_argument if t_s is negative or NaN
  [[nodiscard]] MotionSample sample(double t_s) const;
  [[nodiscard]] PowerCubic power(int j) const;  ///< power coefficients of interval j in u
  [[nodiscard]] Points4 minvo(int j) const;     ///< MINVO points of interval j, m.
  /// Returns the MINVO points of the part [u0, u1] of interval j: P(u0 + s(u1 − u0)) in powers of s, times A⁻¹.
  /// @throws std::invalid_argument unless 0 ≤ u0 < u1 ≤ 1
  [[nodiscard]] Points4 minvo(int j, double u0, double u1) const;
  /// Returns the smallest box (m) that contains the curve on interval j. The extrema lie at u = 0, at u = 1 and at the
  /// roots of dP/du.
  [[nodiscard]] Box position_bounds(int j) const;
  /// True if q_{n-2} = q_{n-1} = q_n to the last bit, so that velocity and acceleration are zero at the end.
  [[nodiscard]] bool ends_at_rest() const;

 private:
  Points control_points_;
  double interval_s_;
  const SplineBasis* basis_;
};

/// Returns q_0, q_1, q_2 for a start state (Algorithm 1, line 1):
///
///     q_0 = p,   q_1 = q_0 + v Δt/3,   q_2 = q_1 + (v + a Δt/2) · 2Δt/3
///
/// A spline with J ≥ 2 and these control points starts with p, v and a of `start`.
/// @throws std::invalid_argument unless Δt > 0
Points3 start_control_points(const MotionSample& start, double interval_s);

/// Returns the spline that stays at p (W, m).
ClampedSpline at_rest(const Vec3& p, int intervals, double interval_s);

/// The largest |v|, |a|, |j| per axis: true extrema, not bounds from control points. Up to rounding (about 1e-15 of
/// the value) a comparison with a limit is therefore exact.
struct MotionBounds {
  Vec3 v_max = Vec3::Zero();  ///< m/s, ≥ 0
  Vec3 a_max = Vec3::Zero();  ///< m/s², ≥ 0
  Vec3 j_max = Vec3::Zero();  ///< m/s³, ≥ 0
};

/// Returns the extrema on interval j. With P(u) = c_3 u³ + c_2 u² + c_1 u + c_0 per axis:
///
///     v(u) = (3c_3 u² + 2c_2 u + c_1)/Δt, largest at u = 0, u = 1 or the vertex u = −c_2/(3c_3) if that is inside
///     a(u) = (6c_3 u + 2c_2)/Δt², largest at u = 0 or u = 1
///     j = 6c_3/Δt³, constant
MotionBounds motion_bounds(const ClampedSpline& spline, int j);

/// Returns the extrema over all intervals. O(J).
MotionBounds motion_bounds(const ClampedSpline& spline);

}  // namespace tern
