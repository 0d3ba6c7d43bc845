// The length of a path of points.
#pragma once

#include <vector>

#include "core/base/types.h"

namespace tern {

/// Returns the length of a piecewise linear path, m.
inline double path_length(const std::vector<Vec3>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace tern
