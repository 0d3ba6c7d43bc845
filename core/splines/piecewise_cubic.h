// A motion as cubic pieces in time: what predictions and declared motions are made of.
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

/// Pieces one after the other from `start`; each piece may jump (a prediction is not promised to be continuous).
/// Functions of it are O(pieces) and throw std::invalid_argument when there is no piece.
struct PiecewiseCubic {
  UTime start;
  std::vector<CubicPiece> pieces;  ///< ≥ 1

  [[nodiscard]] UTime end() const;
  struct Located {
    std::size_t index = 0;
    UTime start;  ///< of that piece
  };
  /// The piece that holds t (at a joint: the later one) and its start. Clamps to the first and last piece:
  /// extrapolation is the caller's, as Track's growing box beyond its last piece.
  [[nodiscard]] Located locate(UTime t) const;
  [[nodiscard]] MotionSample sample(UTime t) const;  ///< within [start, end]; beyond, the end piece's polynomial
};

/// Position, velocity, acceleration, jerk of a cubic at τ seconds.
MotionSample sample_cubic(const PowerCubic& coefficients, double tau_s);
/// Its position alone.
inline Vec3 position_of(const PowerCubic& c, double tau_s) {
  return ((c.col(0) * tau_s + c.col(1)) * tau_s + c.col(2)) * tau_s + c.col(3);
}

/// Largest |velocity| per axis of the cubic on [t0, t1]: exact, at an end or at the vertex τ = −c_2/(3c_3) of the
/// parabola.
Vec3 max_abs_velocity(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Largest |acceleration| per axis of the cubic on [t0, t1]: exact, at an end (acceleration is linear).
Vec3 max_abs_acceleration(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Tight axis-aligned bounds of the cubic on [t0, t1] (extrema by roots of the derivative), right to rounding.
Box cubic_bounds(const PowerCubic& coefficients, double t0_s, double t1_s);

/// The piece over [t0, t1] on the unit parameter: s ↦ c(t0 + s(t1 − t0)), s ∈ [0, 1].
PowerCubic reparametrized(const PowerCubic& coefficients, double t0_s, double t1_s);

/// The cubic Hermite piece: it has the positions and velocities of its two ends (a and j of the samples are not read).
/// With h the duration, d = (p_1 − p_0)/h:  c_3 = (v_0 + v_1 − 2d)/h², c_2 = (3d − 2v_0 − v_1)/h, c_1 = v_0, c_0 = p_0.
/// @throws std::invalid_argument unless duration > 0.
CubicPiece hermite_piece(const MotionSample& from, const MotionSample& to, Duration duration);

/// A motion (W) by the time since its start; only p and v are read.
using MotionFunction = std::function<MotionSample(Duration since_start)>;

/// `pieces` cubic Hermite pieces of one length, interpolating p and v of `motion` at each joint (so it is called pieces
/// + 1 times): C¹, and at most hermite_error_bound() from it. @throws std::invalid_argument unless piece > 0 and pieces
/// ≥ 1.
PiecewiseCubic hermite_fit(UTime start, Duration piece, int pieces, const MotionFunction& motion);

/// Largest distance per axis of a cubic Hermite piece of length h from the function that it interpolates, m. It is the
/// remainder of Hermite interpolation at τ = h/2: |p(t) − H(t)| = |p⁗(ξ)|/24 · τ²(h − τ)² ≤ h⁴/384 · max|p⁗|.
/// @param max_fourth_derivative m/s⁴, ≥ 0, over the piece.
double hermite_error_bound(double h_s, double max_fourth_derivative);

/// What remains of a spline that started at `spline_start`, from `from` to its end; the same curve to rounding. The
/// first piece may be a part of an interval, the others are its intervals.
/// @throws std::invalid_argument unless spline_start ≤ from < end and Δt is a whole number of µs (to 1e-3 µs).
PiecewiseCubic remaining_motion(const ClampedSpline& spline, UTime spline_start, UTime from);

}  // namespace tern
