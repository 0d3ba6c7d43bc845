// A motion as cubic pieces in time. Predictions and declared motions have this form.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/base/time.h"
#include "core/splines/clamped_spline.h"

namespace tern {

/// One cubic: p(τ) = c · [τ³ τ² τ 1]ᵀ with τ seconds since the piece's start.
struct CubicPiece {
  Duration duration;                             ///< > 0
  PowerCubic coefficients = PowerCubic::Zero();  ///< 3×4, columns τ³ τ² τ 1; m/s³ … m
};

/// Cubic pieces, one after the other, from `start` on. The motion may jump at a joint: predictions need not be
/// continuous. Its functions take O(pieces) and throw std::invalid_argument if there is no piece.
struct PiecewiseCubic {
  UTime start;
  std::vector<CubicPiece> pieces;  ///< ≥ 1

  [[nodiscard]] UTime end() const;
  /// A piece and the time at which it starts.
  struct Located {
    std::size_t index = 0;
    UTime start;
  };
  /// Returns the piece at time t; at a joint the later one. Times before the start give the first piece, times after
  /// the end give the last one.
  [[nodiscard]] Located locate(UTime t) const;
  /// Returns the motion at time t. Outside [start(), end()] it is the polynomial of the first or last piece.
  [[nodiscard]] MotionSample sample(UTime t) const;
};

/// Returns position, velocity, acceleration and jerk of a cubic at τ seconds.
MotionSample sample_cubic(const PowerCubic& coefficients, double tau_s);
/// Returns the position of a cubic at τ seconds.
inline Vec3 position_of(const PowerCubic& c, double tau_s) {
  const auto along = [&](int axis) {
    return ((c(axis, 0) * tau_s + c(axis, 1)) * tau_s + c(axis, 2)) * tau_s + c(axis, 3);
  };
  return {along(0), along(1), along(2)};
}

/// Returns the largest |velocity| per axis of a cubic on [t0, t1]. It is exact: the velocity is a parabola, whose
/// extrema lie at the ends and at τ = −c_2/(3c_3).
Vec3 max_abs_velocity(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Returns the largest |acceleration| per axis of a cubic on [t0, t1]. It is exact: the acceleration is linear.
Vec3 max_abs_acceleration(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Returns the smallest box that contains a cubic on [t0, t1], up to rounding, from the roots of its derivative.
Box cubic_bounds(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Returns the coefficients of s ↦ c(t0 + s(t1 − t0)), s ∈ [0, 1].
PowerCubic reparametrized(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Returns the cubic Hermite piece with the positions and velocities of two samples; their a and j are not read. With
/// h the duration and d = (p_1 − p_0)/h:
///
///     c_3 = (v_0 + v_1 − 2d)/h²,   c_2 = (3d − 2v_0 − v_1)/h,   c_1 = v_0,   c_0 = p_0
///
/// @throws std::invalid_argument unless duration > 0
CubicPiece hermite_piece(const MotionSample& from, const MotionSample& to, Duration duration);

/// A motion in W as a function of the time since its start. Only p and v of its values are read.
using MotionFunction = std::function<MotionSample(Duration since_start)>;

/// Returns `pieces` cubic Hermite pieces of one length that interpolate p and v of `motion` at each joint. The result
/// is C¹ and differs from `motion` by at most hermite_error_bound(). `motion` is called pieces + 1 times.
/// @throws std::invalid_argument unless piece > 0 and pieces ≥ 1
PiecewiseCubic hermite_fit(UTime start, Duration piece, int pieces, const MotionFunction& motion);

/// Returns the largest distance per axis, m, of a cubic Hermite piece of length h from the function that it
/// interpolates. The remainder of Hermite interpolation is largest at τ = h/2:
///
///     |p(τ) − H(τ)| = |p⁗(ξ)|/24 · τ²(h − τ)² ≤ h⁴/384 · max|p⁗|
///
/// @param max_fourth_derivative  max|p⁗| over the piece, m/s⁴, ≥ 0
double hermite_error_bound(double h_s, double max_fourth_derivative);

/// Returns the part of a spline from time `from` to its end, as the same curve up to rounding. The first piece may be
/// a part of an interval; the others are whole intervals.
/// @param spline_start  when the spline starts
/// @throws std::invalid_argument unless spline_start ≤ from < end and Δt is a whole number of µs (to 1e-3 µs)
PiecewiseCubic remaining_motion(const ClampedSpline& spline, UTime spline_start, UTime from);

}  // namespace tern
