// Labels voxels from a point cloud.
#pragma once

#include "semantic_mapper/voxel_map/map_builder.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

namespace tern {

/// Labels the voxels of a point cloud.
///
/// 1. Each point marks its voxel, and all voxels whose centre lies within point_radius. Points outside the grid are
///    ignored.
/// 2. A voxel with at least min_points marks of one label gets that label. Its class is the one with the most marks;
///    of equal counts, the one with the lower number.
/// 3. The column below a voxel of a fill_below class gets the same label, down to the map's floor. So the roofs of an
///    airborne scan become solid buildings.
/// @return false if points mark voxels of the grid, but no voxel has min_points marks of one label
bool paint_cloud(const CloudLayer& cloud, VoxelPainter& painter);

}  // namespace tern
