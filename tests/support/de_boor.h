// Oracle: a point of a clamped uniform cubic B-spline, computed from the knots by de Boor's algorithm.
#pragma once

#include <algorithm>
#include <array>

#include "core/base/types.h"

namespace tern::oracle {

/// Returns P(t), t ∈ [0, JΔt], by three rounds r = 1, 2, 3 of affine combinations of control points. With the knots
/// τ_i = clamp(i − 3, 0, J):
///
///     d_i ← (1 − α) d_{i−1} + α d_i,   α = (τ − τ_i)/(τ_{i+4−r} − τ_i)
inline Vec3 de_boor(const Points& q, double interval_s, double t_s) {
  const int intervals = static_cast<int>(q.cols()) - 3;
  const auto knot = [intervals](int i) { return static_cast<double>(std::clamp(i - 3, 0, intervals)); };
  const double tau = t_s / interval_s;
  const int j = std::clamp(static_cast<int>(tau), 0, intervals - 1);
  std::array<Vec3, 4> d;
  for (int i = 0; i < 4; ++i) d[static_cast<std::size_t>(i)] = q.col(j + i);
  for (int r = 1; r <= 3; ++r) {
    for (int i = 3; i >= r; --i) {
      const double alpha = (tau - knot(j + i)) / (knot(j + i + 4 - r) - knot(j + i));
      const auto k = static_cast<std::size_t>(i);
      d[k] = ((1.0 - alpha) * d[k - 1] + alpha * d[k]).eval();
    }
  }
  return d[3];
}

}  // namespace tern::oracle
