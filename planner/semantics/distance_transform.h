// The exact Euclidean distance transform of Felzenszwalb and Huttenlocher (Theory of Computing 8, 2012).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Squared distances, in voxels², from every voxel's centre to the nearest set voxel's centre; +∞ where none is set.
/// Three passes of lower envelopes of parabolas, one per axis; O(voxels). x runs fastest. Exact (integers below 2²⁴)
/// for grids whose diagonal is under 4096 voxels.
/// @param set  size.prod() entries, non-zero: set
std::vector<float> squared_distance_transform(const std::vector<std::uint8_t>& set, const Eigen::Vector3i& size);

}  // namespace tern
