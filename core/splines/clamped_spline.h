// The trajectory's form (paper §2): a clamped uniform cubic B-spline with J intervals of one length.
#pragma once

#include <memory>

#include "core/base/types.h"
#include "core/splines/minvo.h"

namespace tern {

/// Splines have 1 to this many intervals (planning uses J ≥ 4; from there on no interval is clamped at both ends).
inline constexpr int kMaxIntervals = 128;

/// Everything that depends on J alone (knots in units of Δt): made once per J and shared.
///
/// Knots τ_i = clamp(i − 3, 0, J), i = 0 … J + 6. Interval j ∈ [0, J) is u = τ − j ∈ [0, 1] and uses control points
/// q_j … q_{j+3} (n = J + 2, so J + 3 points). With Q_j their 3×4 matrix:
/// power coefficients Q_j · power(j); MINVO points Q_j · position_minvo(j) = Q_j · power(j) · A⁻¹.
/// Velocity (degree 2 in u): MINVO points of dP/du = Q_j · velocity_minvo(j), divide by Δt for m/s.
/// power(j) comes from the Cox–de Boor recursion on the knots, as polynomials of u:
///   N_{i,k} = (τ − τ_i)/(τ_{i+k} − τ_i) N_{i,k−1} + (τ_{i+k+1} − τ)/(τ_{i+k+1} − τ_{i+1}) N_{i+1,k−1}, 0/0 = 0,
/// so the first two and last two intervals have their own matrices. All accessors throw std::out_of_range unless
/// 0 ≤ j < J, allocate nothing and take a few ns.
class SplineBasis {
 public:
  /// @param intervals 1 ≤ J ≤ kMaxIntervals. @throws std::invalid_argument otherwise.
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

/// The shared basis of J intervals: made at first use, kept for the life of the process, safe from any thread.
/// @throws std::invalid_argument unless 1 ≤ J ≤ kMaxIntervals.
const SplineBasis& spline_basis(int intervals);

/// A motion sample in W.
struct MotionSample {
  Vec3 p = Vec3::Zero();  ///< m
  Vec3 v = Vec3::Zero();  ///< m/s
  Vec3 a = Vec3::Zero();  ///< m/s²
  Vec3 j = Vec3::Zero();  ///< m/s³
};

/// A clamped uniform cubic B-spline in W; time counts from its own start, seconds. Past its end it rests at its last
/// point (only meaningful when it ends at rest), before its start it throws. Interval indices outside [0, J) throw
/// std::out_of_range. No member function allocates. Derivatives are computed from differences of control points, so
/// they keep their digits far from the origin, and coinciding control points give exact zeros.
class ClampedSpline {
 public:
  /// @param control_points 3×(J+3), 1 ≤ J ≤ kMaxIntervals, finite; @param interval_s Δt > 0, finite.
  /// @throws std::invalid_argument otherwise.
  ClampedSpline(Points control_points, double interval_s);

  [[nodiscard]] int intervals() const { return basis_->intervals(); }
  [[nodiscard]] double interval_s() const { return interval_s_; }
  [[nodiscard]] double duration_s() const { return interval_s_ * intervals(); }
  [[nodiscard]] const Points& control_points() const { return control_points_; }
  [[nodiscard]] const SplineBasis& basis() const { return *basis_; }

  /// State at t_s ≥ 0. Jerk at an inner knot is the right-hand one, at duration_s() the left-hand one. After that p =
  /// q_n and v, a, j are zero.
  /// @throws std::invalid_argument if t_s is negative or not a number.
  [[nodiscard]] MotionSample sample(double t_s) const;
  [[nodiscard]] PowerCubic power(int j) const;  ///< interval j as powers of u
  [[nodiscard]] Points4 minvo(int j) const;     ///< MINVO points of interval j, m
  /// MINVO points of the part [u0, u1] of interval j: P(u0 + s(u1 − u0)) in powers of s, times A⁻¹.
  /// @throws std::invalid_argument unless 0 ≤ u0 < u1 ≤ 1.
  [[nodiscard]] Points4 minvo(int j, double u0, double u1) const;
  /// Tight box of the curve on interval j, m: per axis the values at u = 0, 1 and at the roots of dP/du in between.
  [[nodiscard]] Box position_bounds(int j) const;
  /// True if q_{n-2} = q_{n-1} = q_n to the last bit: velocity and acceleration end at zero.
  [[nodiscard]] bool ends_at_rest() const;

 private:
  Points control_points_;
  double interval_s_;
  const SplineBasis* basis_;
};

/// q_0, q_1, q_2 from the start state: q_1 = q_0 + v Δt/3, q_2 = q_1 + (v + a Δt/2)·2Δt/3 (Algorithm 1, line 1).
/// A spline with these (J ≥ 2) starts with start.p, start.v, start.a. @throws std::invalid_argument unless Δt > 0.
Points3 start_control_points(const MotionSample& start, double interval_s);

/// The spline that stays at p (W, m): all control points equal.
ClampedSpline at_rest(const Vec3& p, int intervals, double interval_s);

/// Largest |v|, |a|, |j| per axis. True extrema, not bounds by control points. Limits compared with these refuse
/// nothing legal and pass nothing illegal, but for rounding (about 1e-15 of the value).
struct MotionBounds {
  Vec3 v_max = Vec3::Zero();  ///< m/s, ≥ 0
  Vec3 a_max = Vec3::Zero();  ///< m/s², ≥ 0
  Vec3 j_max = Vec3::Zero();  ///< m/s³, ≥ 0
};

/// On interval j, with P(u) = c_3 u³ + c_2 u² + c_1 u + c_0 per axis:
///
///     v(u) = (3c_3 u² + 2c_2 u + c_1)/Δt, largest at u = 0, u = 1 or the vertex u = −c_2/(3c_3) if that is inside
///     a(u) = (6c_3 u + 2c_2)/Δt², largest at u = 0 or u = 1
///     j = 6c_3/Δt³, constant
MotionBounds motion_bounds(const ClampedSpline& spline, int j);

/// The same over all intervals. O(J).
MotionBounds motion_bounds(const ClampedSpline& spline);

}  // namespace tern
