// Trilinear interpolation of samples at integer coordinates.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Returns the interpolated value at x, in grid steps, each within [0, size − 1] up to rounding. The samples' x index
/// runs fastest.
/// @pre every size ≥ 2
inline double trilinear(const std::vector<float>& samples, const Eigen::Vector3i& size, const Vec3& x) {
  const int i = std::clamp(static_cast<int>(x.x()), 0, size.x() - 2);
  const int j = std::clamp(static_cast<int>(x.y()), 0, size.y() - 2);
  const int k = std::clamp(static_cast<int>(x.z()), 0, size.z() - 2);
  const double u = x.x() - i;
  const double v = x.y() - j;
  const double w = x.z() - k;
  const auto row = static_cast<std::size_t>(size.x());
  const std::size_t layer = row * static_cast<std::size_t>(size.y());
  const float* s = samples.data() + idx(i) + row * idx(j) + layer * idx(k);
  const auto along = [u](const float* at) {
    const double first = at[0];
    return first + u * (static_cast<double>(at[1]) - first);
  };
  const double low = along(s) + v * (along(s + row) - along(s));
  const double high = along(s + layer) + v * (along(s + layer + row) - along(s + layer));
  return low + w * (high - low);
}

}  // namespace tern
