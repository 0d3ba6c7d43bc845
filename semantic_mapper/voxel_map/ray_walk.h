// Walks along a ray, voxel by voxel (Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/world/voxel_map.h"

namespace tern {

/// Calls visit(index) for each voxel of the grid that the segment from a to b passes, in order. The first voxel is that
/// of a, and the last one that of b, as far as they lie in the grid. O(voxels passed).
/// @pre a and b are finite
template <class Visit>
void walk_ray(const VoxelGrid& grid, const Vec3& a, const Vec3& b, Visit&& visit) {
  const Box bounds = grid.bounds();
  const Vec3 d = b - a;
  double enter = 0.0;
  double leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0 && (a[i] < bounds.min()[i] || a[i] > bounds.max()[i])) return;
    if (d[i] == 0.0) continue;
    double first = (bounds.min()[i] - a[i]) / d[i];
    double second = (bounds.max()[i] - a[i]) / d[i];
    if (first > second) std::swap(first, second);
    enter = std::max(enter, first);
    leave = std::min(leave, second);
  }
  if (enter > leave || grid.voxels() == 0) return;

  const Eigen::Vector3i top = grid.size - Eigen::Vector3i::Ones();
  Eigen::Vector3i cell = grid.cell_of(a + enter * d).cwiseMax(0).cwiseMin(top);
  const Eigen::Vector3i last = grid.cell_of(a + leave * d).cwiseMax(0).cwiseMin(top);
  Eigen::Vector3i left = (last - cell).cwiseAbs();
  Vec3 next = Vec3::Zero();  // the ray's parameter where it leaves the present cell, per axis
  for (int i = 0; i < 3; ++i) {
    if (left[i] == 0) continue;
    const double wall = grid.origin[i] + grid.resolution * (cell[i] + (last[i] > cell[i] ? 1 : 0));
    next[i] = (wall - a[i]) / d[i];
  }
  visit(grid.index(cell));
  while (left.sum() > 0) {
    int axis = 0;
    double soonest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      if (left[i] == 0 || next[i] >= soonest) continue;
      soonest = next[i];
      axis = i;
    }
    cell[axis] += last[axis] > cell[axis] ? 1 : -1;
    --left[axis];
    next[axis] += grid.resolution / std::abs(d[axis]);
    visit(grid.index(cell));
  }
}

}  // namespace tern
