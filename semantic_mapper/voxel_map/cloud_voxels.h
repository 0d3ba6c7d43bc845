// A labelled point cloud becomes voxels.
#pragma once

#include "semantic_mapper/voxel_map/map_builder.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

namespace tern {

/// Paints a cloud. Each point marks its voxel and those whose centre lies within point_radius. A voxel with at least
/// min_points marks of one label is painted with it, under the class with the most marks (ties: the lower number).
/// Columns below voxels of the fill_below classes are painted alike, down to the map's floor. So an airborne scan's
/// roofs become solid buildings. Points outside the grid are left out.
void paint_cloud(const CloudLayer& cloud, VoxelPainter& painter);

}  // namespace tern
