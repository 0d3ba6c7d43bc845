// Geofences as voxels.
#pragma once

#include <vector>

#include "core/world/fence.h"
#include "core/world/voxel_map.h"

namespace tern {

/// Labels every voxel that a fence forbids Occupied, all others Unknown. The rounding is conservative: a body that
/// stays clear of these voxels never exceeds a fence.
///
/// * An inclusion fence forbids every voxel that is not wholly inside it. Of several inclusion fences, a voxel must be
///   wholly inside one.
/// * An exclusion fence forbids every voxel that it overlaps.
///
/// A voxel that a fence's side only touches, to kFenceTouch, is on one side of it. So fences on the grid's planes lose
/// nothing; others lose less than a voxel (a voxel's diagonal where sides are oblique).
///
/// O(voxels · fences + rows · corners). @pre no fence is geodetic, polygons are simple
std::vector<VoxelLabel> fence_labels(const std::vector<Fence>& fences, const VoxelGrid& grid);

/// Returns the box that a map must cover so that its voxels hold the fences. It contains inclusion fences with a wall
/// of one voxel around them, and exclusion fences, both inside the flight box.
/// @param flight_box  empty: unbounded
Box fenced_box(const std::vector<Fence>& fences, const Box& flight_box, double resolution);

/// Sides and voxels that overlap by less than this touch only, m: rounding of coordinates up to 1e5 m.
inline constexpr double kFenceTouch = 1e-6;

}  // namespace tern
