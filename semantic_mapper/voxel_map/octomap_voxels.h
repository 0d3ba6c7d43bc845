// Labels voxels from an OctoMap.
#pragma once

#include "semantic_mapper/sources/octomap.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

namespace tern {

/// Labels the voxels of an OctoMap's leaves. An occupied leaf marks every voxel that it overlaps, a free leaf every
/// voxel whose centre it contains. So a voxel of which a part is occupied is occupied. O(leaves + voxels in leaves).
void paint_octomap(const OctoMapFile& octomap, VoxelPainter& painter);

}  // namespace tern
