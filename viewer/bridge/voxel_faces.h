// Merges the outer faces of labelled voxels into few rectangles, for drawing.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/body_distance.h"
#include "core/world/voxel_map.h"

namespace tern {

/// A rectangle of voxel faces with one orientation, in whole voxels of the drawn grid.
struct VoxelFace {
  VoxelLabel label = VoxelLabel::Free;
  std::uint8_t direction = 0;                      ///< 0 … 5: −x, +x, −y, +y, −z, +z
  Eigen::Vector3i low = Eigen::Vector3i::Zero();   ///< least corner of the rectangle
  Eigen::Vector3i high = Eigen::Vector3i::Zero();  ///< greatest corner; equal to low along the direction's axis
};

/// The faces of a map.
struct VoxelSurface {
  VoxelGrid grid;  ///< as drawn: the map's grid, or a coarser one
  std::vector<VoxelFace> faces;
  std::vector<bool> occupied;  ///< by grid.index
};

/// Returns every face between a voxel labelled occupied, attractive or repulsive and one of another label, or the
/// grid's outside. Faces are merged greedily. A grid of more than `max_voxels` is first coarsened by an integer factor.
/// A coarse voxel gets the first of these labels that it contains: occupied, repulsive, attractive. O(voxels).
VoxelSurface voxel_surface(const VoxelMap& map, std::int64_t max_voxels = 4'000'000);

/// Returns the signed distance from the body at p to the nearest face of an occupied voxel as drawn, m; infinity if
/// there is none. A body that reaches through a face, or whose position is inside an occupied voxel, has a negative
/// distance. In a coarsened map it is at most the true distance. O(faces).
double distance_to_occupied(const VoxelSurface& surface, const BodyDistance& body, const Vec3& p);

}  // namespace tern
