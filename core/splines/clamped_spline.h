// The trajectory's form (paper §2): a clamped uniform cubic B-spline with J ≥ 4 intervals of one length.
#pragma once

#include <memory>

#include "core/base/types.h"

namespace tern {

using Points4 = Eigen::Matrix<double, 3, 4>;  ///< a point per column
using Points3 = Eigen::Matrix<double, 3, 3>;
using PowerCubic = Eigen::Matrix<double, 3, 4>;  ///< coefficients of u³ u² u 1, u ∈ [0, 1], a row per axis

/// Everything that depends on J alone (knots in units of Δt): made once per J and shared.
///
/// Interval j ∈ [0, J) uses control points q_j … q_{j+3} (n = J + 2, so J + 3 points). With Q_j their 3×4 matrix:
/// power coefficients Q_j · power(j); MINVO points Q_j · position_minvo(j) = Q_j · power(j) · A⁻¹.
/// Velocity (degree 2 in u): MINVO points of dP/du = Q_j · velocity_minvo(j), divide by Δt for m/s.
/// The first two and last two intervals have their own matrices (knots clamped).
class SplineBasis {
 public:
  /// @param intervals J ≥ 4. @throws std::invalid_argument otherwise.
  explicit SplineBasis(int intervals);

  [[nodiscard]] int intervals() const { return intervals_; }
  [[nodiscard]] int control_points() const { return intervals_ + 3; }
  [[nodiscard]] const Eigen::Matrix4d& power(int j) const;             ///< 4×4: B-spline → powers u³ u² u 1
  [[nodiscard]] const Eigen::Matrix4d& position_minvo(int j) const;    ///< 4×4: B-spline → MINVO of position
  [[nodiscard]] const Eigen::Matrix<double, 4, 3>& velocity_minvo(int j) const;   ///< 4×3: B-spline → MINVO of dP/du
  [[nodiscard]] const Eigen::Matrix<double, 4, 3>& velocity_bezier(int j) const;  ///< 4×3: B-spline → Bézier of dP/du
  [[nodiscard]] const Eigen::Matrix<double, 4, 2>& acceleration_ends(int j) const;  ///< 4×2: d²P/du² at u = 0 and u = 1
  [[nodiscard]] const Eigen::Vector4d& jerk(int j) const;              ///< 4×1: d³P/du³, constant on the interval

 private:
  int intervals_;
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

/// The shared basis of J intervals (made at first use, thread-safe).
const SplineBasis& spline_basis(int intervals);

/// A motion sample in W.
struct MotionSample {
  Vec3 p = Vec3::Zero();  ///< m
  Vec3 v = Vec3::Zero();  ///< m/s
  Vec3 a = Vec3::Zero();  ///< m/s²
  Vec3 j = Vec3::Zero();  ///< m/s³
};

/// A clamped uniform cubic B-spline in W; time counts from its own start, seconds. Past its end it rests at its last point
/// (only meaningful when it ends at rest), before its start it throws.
class ClampedSpline {
 public:
  /// @param control_points 3×(J+3), J ≥ 4, finite; @param interval_s Δt > 0. @throws std::invalid_argument otherwise.
  ClampedSpline(Points control_points, double interval_s);

  [[nodiscard]] int intervals() const { return static_cast<int>(control_points_.cols()) - 3; }
  [[nodiscard]] double interval_s() const { return interval_s_; }
  [[nodiscard]] double duration_s() const { return interval_s_ * intervals(); }
  [[nodiscard]] const Points& control_points() const { return control_points_; }

  [[nodiscard]] MotionSample sample(double t_s) const;                 ///< t_s ≥ 0; jerk at a knot is the right-hand one
  [[nodiscard]] PowerCubic power(int j) const;                         ///< interval j as powers of u
  [[nodiscard]] Points4 minvo(int j) const;                            ///< MINVO points of interval j
  /// MINVO points of the part [u0, u1] of interval j, 0 ≤ u0 < u1 ≤ 1.
  [[nodiscard]] Points4 minvo(int j, double u0, double u1) const;
  /// True if q_{n-2} = q_{n-1} = q_n to the last bit: velocity and acceleration end at zero.
  [[nodiscard]] bool ends_at_rest() const;

 private:
  Points control_points_;
  double interval_s_;
};

/// q_0, q_1, q_2 from the start state: q_1 = q_0 + v Δt/3, q_2 = q_1 + (v + a Δt/2)·2Δt/3 (Algorithm 1, line 1).
Points3 start_control_points(const MotionSample& start, double interval_s);

}  // namespace tern
