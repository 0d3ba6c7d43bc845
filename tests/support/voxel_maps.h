// Voxel maps for tests: free ones, random ones, boxes.
#pragma once

#include "core/base/random.h"
#include "core/world/voxel_map.h"

namespace tern::support {

/// Returns a map of free voxels.
inline VoxelMap free_map(const Eigen::Vector3i& size, double resolution = 0.25, const Vec3& origin = Vec3::Zero()) {
  VoxelMap map;
  map.grid = {origin, resolution, size};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {""};
  map.version = map.compute_version();
  return map;
}

/// Labels the voxels low … high (inclusive). @pre they lie in the grid
inline void paint(VoxelMap& map, const Eigen::Vector3i& low, const Eigen::Vector3i& high, VoxelLabel label) {
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) map.labels[static_cast<std::size_t>(map.grid.index({x, y, z}))] = label;
    }
  }
  map.version = map.compute_version();
}

/// Gives each voxel the label with this probability.
inline void sprinkle(VoxelMap& map, Rng& rng, double probability, VoxelLabel label) {
  for (VoxelLabel& l : map.labels) {
    if (rng.uniform() < probability) l = label;
  }
  map.version = map.compute_version();
}

}  // namespace tern::support
