// The labelled voxels of a map as few boxes.
#pragma once

#include <vector>

#include "core/world/voxel_map.h"

namespace tern::exporting {

struct MapBox {
  VoxelLabel label = VoxelLabel::Occupied;  ///< Occupied, Attractive or Repulsive
  std::uint8_t class_index = 0;             ///< into VoxelMap::class_names
  Eigen::Vector3i low, high;                ///< first and last voxel
};

/// Boxes of equal label and class, each grown along x, then y, then z. Every occupied, attractive and repulsive voxel
/// is in exactly one, no other in any. Takes time and a bit per voxel.
std::vector<MapBox> map_boxes(const VoxelMap& map);

}  // namespace tern::exporting
