// Fences that are added to a map that is already made: those that a ground station uploads.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/fence.h"
#include "core/world/voxel_map.h"

namespace tern {

/// The class of voxels that are occupied because an uploaded fence forbids them, and for no other reason.
inline constexpr const char* kUploadedFence = "uploaded fence";
/// The largest product of fences and voxels: about two seconds of work.
inline constexpr double kMaxFenceWork = 2e9;

/// Returns fence_labels() of the map's grid; without fences nothing. O(voxels · fences).
/// @param flight_box  only what lies inside counts; empty: unbounded
/// @return an Error if the grid ends within a fence inside the flight box, or for more work than kMaxFenceWork
/// @pre no fence is geodetic, polygons are simple
Result<std::vector<VoxelLabel>> uploaded_fence_labels(const std::vector<Fence>& fences, const VoxelGrid& grid,
                                                      const Box& flight_box);

/// Makes occupied, of class kUploadedFence, what the labels say is occupied and the map does not. (Of no class, if the
/// map has kMaxMapClasses already.) Sets the version.
/// @param labels  uploaded_fence_labels() of the map's grid
void add_uploaded_fences(const std::vector<VoxelLabel>& labels, VoxelMap& map);

/// Returns whether all that the labels say is occupied is so in the map.
/// @param labels  uploaded_fence_labels() of the map's grid
bool holds_fences(const VoxelMap& map, const std::vector<VoxelLabel>& labels);

/// Frees the voxels of class kUploadedFence, whatever they were without the fences: that is not known. The version
/// stays.
void free_uploaded_fences(VoxelMap& map);

}  // namespace tern
