// A motion as cubic pieces in time: what predictions and declared motions are made of.
#pragma once

#include <vector>

#include "core/base/time.h"
#include "core/splines/clamped_spline.h"

namespace tern {

/// One cubic: p(τ) = c · [τ³ τ² τ 1]ᵀ with τ seconds since the piece's start.
struct CubicPiece {
  Duration duration;                                 ///< > 0
  PowerCubic coefficients = PowerCubic::Zero();      ///< 3×4, columns τ³ τ² τ 1; m/s³ … m
};

/// Pieces one after the other from `start`; each piece may jump (a prediction is not promised to be continuous).
struct PiecewiseCubic {
  UTime start;
  std::vector<CubicPiece> pieces;  ///< ≥ 1

  [[nodiscard]] UTime end() const;
  /// The piece that holds t and its start; clamps to the first and last piece (extrapolation is the caller's business:
  /// see Track, whose region beyond its last piece is a growing box).
  struct Located {
    std::size_t index = 0;
    UTime start;
  };
  [[nodiscard]] Located locate(UTime t) const;
  [[nodiscard]] MotionSample sample(UTime t) const;  ///< within [start, end]; beyond, the end piece's polynomial
};

/// Position, velocity, acceleration, jerk of a cubic at τ seconds.
MotionSample sample_cubic(const PowerCubic& coefficients, double tau_s);

/// Largest |acceleration| per axis of the cubic on [t0, t1]: exact, at an end (acceleration is linear).
Vec3 max_abs_acceleration(const PowerCubic& coefficients, double t0_s, double t1_s);

/// Tight axis-aligned bounds of the cubic on [t0, t1] (extrema by roots of the derivative).
Box cubic_bounds(const PowerCubic& coefficients, double t0_s, double t1_s);

}  // namespace tern
