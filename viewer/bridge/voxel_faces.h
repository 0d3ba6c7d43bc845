// The outer faces of labelled voxels, as few rectangles: what a page draws of a map.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/voxel_map.h"

namespace tern {

/// A rectangle of voxel faces that look the same way, in whole voxels of the drawn grid.
struct VoxelFace {
  VoxelLabel label = VoxelLabel::Free;
  std::uint8_t direction = 0;                      ///< 0 … 5: −x, +x, −y, +y, −z, +z
  Eigen::Vector3i low = Eigen::Vector3i::Zero();   ///< least corner of the rectangle
  Eigen::Vector3i high = Eigen::Vector3i::Zero();  ///< greatest corner; equal to low along the direction's axis
};

struct VoxelSurface {
  VoxelGrid grid;  ///< of the drawing: the map's, or a coarser one
  std::vector<VoxelFace> faces;
  std::vector<bool> occupied;  ///< by grid.index
};

/// Every face between an occupied, attractive or repulsive voxel and one of another label (or the grid's outside),
/// joined greedily to rectangles. A grid of more than `max_voxels` is coarsened first by a whole factor: a coarse voxel
/// has the gravest label within it (occupied, repulsive, attractive). O(voxels).
VoxelSurface voxel_surface(const VoxelMap& map, std::int64_t max_voxels = 4'000'000);

/// From p to the nearest occupied voxel as drawn, m (of a coarsened map no farther than it is). It is 0 within one,
/// infinity where there is none. O(faces).
double distance_to_occupied(const VoxelSurface& surface, const Vec3& p);

}  // namespace tern
