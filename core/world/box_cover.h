// Occupied voxels as few axis-aligned boxes: what planner and referee keep clear of.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/voxel_map.h"

namespace tern {

/// Disjoint boxes whose union is exactly that of the grid's voxels that are `wanted` (by index).
///
/// Greedy: from the first uncovered voxel (in index order) the box grows to its full run along one axis, then over
/// whole rows, then layers. Of the three starting axes the one of largest volume is kept. Not the least number of boxes
/// (that is NP-hard), but one for a box, and a wall with a window in 4 to 5. O(voxels) time for compact shapes, one bit
/// of memory per voxel. The order is that of the boxes' least voxels: the same for the same map.
std::vector<Box> cover_with_boxes(const VoxelGrid& grid, std::vector<bool> wanted);

/// Of the map's obstacle voxels. These are the occupied ones and, when `unknown_is_obstacle`, the unknown ones inside
/// the map's extents. What lies outside the map is nobody's here. CertificatePlane's −1 − k names the k-th box of a map
/// version.
std::vector<Box> cover_with_boxes(const VoxelMap& map, bool unknown_is_obstacle);

}  // namespace tern
