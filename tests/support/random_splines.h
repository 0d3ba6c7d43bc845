// Splines and cubics drawn from a seed, for property tests.
#pragma once

#include "core/base/random.h"
#include "core/splines/clamped_spline.h"

namespace tern::support {

/// Returns an integer, uniform in {lo, …, hi}.
inline int random_integer(Rng& rng, int lo, int hi) { return lo + static_cast<int>(rng.uniform() * (hi - lo + 1)); }

/// Returns a point, uniform in the cube of half-extent h around the origin.
inline Vec3 random_vector(Rng& rng, double h) {
  const double x = rng.uniform(-h, h);
  const double y = rng.uniform(-h, h);
  return {x, y, rng.uniform(-h, h)};
}

/// Returns a random walk of control points within 100 m of the origin. Steps are at most 2 m; one in ten is zero.
inline Points random_control_points(Rng& rng, int intervals) {
  Points q(3, intervals + 3);
  q.col(0) = random_vector(rng, 100.0);
  for (int i = 1; i < q.cols(); ++i) {
    const double step = rng.uniform() < 0.1 ? 0.0 : 2.0;
    q.col(i) = q.col(i - 1) + random_vector(rng, step);
  }
  return q;
}

/// Returns a spline with J from 4 to 12 and Δt from 0.05 to 1 s.
inline ClampedSpline random_spline(Rng& rng) {
  const int intervals = random_integer(rng, 4, 12);
  Points q = random_control_points(rng, intervals);
  return {std::move(q), rng.uniform(0.05, 1.0)};
}

/// Returns coefficients in [-2, 2], some of them zero, so that every degree occurs.
inline PowerCubic random_cubic(Rng& rng) {
  PowerCubic c;
  for (int k = 0; k < 4; ++k) {
    for (int axis = 0; axis < 3; ++axis) c(axis, k) = rng.uniform() < 0.2 ? 0.0 : rng.uniform(-2.0, 2.0);
  }
  return c;
}

}  // namespace tern::support
