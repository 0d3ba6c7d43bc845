// The occupied voxels in which the vehicle stands. They are freed: a place is free if the vehicle is there.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"

namespace tern {

/// Returns the occupied voxels in which the body at p stands, by index. These are the voxels that it overlaps. Those of
/// the same layers that are nearer than half a voxel are added, as room for a tube. The result is empty if the body
/// does not stand at the edge of the occupied space.
///
/// A scan of the ground marks voxels up to a voxel above it, so a vehicle that stands there overlaps them. The body is
/// at the edge if it overlaps no occupied voxel once it is moved by one voxel on one, two or three axes. A body that
/// lies deeper is inside an obstacle. Touching is not overlapping, within kOverlapTolerance.
/// O(voxels near the body).
/// @param labels  per voxel of the grid
std::vector<std::int64_t> voxels_stood_in(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                          const Body& body, const Vec3& p);

/// The same for a body that has left its start. Room for a tube is added only on the ground: if the body's lowest layer
/// alone overlaps occupied voxels. In flight a body beside a wall would open the wall.
std::vector<std::int64_t> voxels_met(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels, const Body& body,
                                     const Vec3& p);

/// Returns the occupied voxels that the body at p overlaps, by index, ascending. O(voxels of the body).
std::vector<std::int64_t> voxels_overlapped(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                            const Body& body, const Vec3& p);

/// A body and a voxel that overlap by less than this only touch, m: rounding of coordinates up to 1e5 m.
inline constexpr double kOverlapTolerance = 1e-6;

}  // namespace tern
