// Occupied voxels as a small number of axis-aligned boxes. The planner and the referee use these boxes as obstacles.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/voxel_map.h"

namespace tern {

/// Returns disjoint boxes whose union is exactly the union of the `wanted` voxels of a grid.
///
/// The method is greedy. From the first uncovered voxel, in index order, a box grows along one axis, then over whole
/// rows, then over whole layers. Each of the three axes is tried as the first one, and the largest box is kept. The
/// smallest number of boxes is NP-hard to find. This method gives 1 box for a box, and 4 to 5 for a wall with a window.
///
/// It takes O(voxels) for compact shapes and one bit of memory per voxel. Boxes are ordered by their first voxel, so
/// equal maps give equal results.
/// @param wanted  an entry per voxel, by VoxelGrid::index
std::vector<Box> cover_with_boxes(const VoxelGrid& grid, std::vector<bool> wanted);

/// Returns the boxes of a map's obstacles: the occupied voxels and, if `unknown_is_obstacle`, the unknown ones. The
/// space outside the map is not covered. CertificatePlane::track = −1 − k names the k-th box of a map version.
std::vector<Box> cover_with_boxes(const VoxelMap& map, bool unknown_is_obstacle);

}  // namespace tern
