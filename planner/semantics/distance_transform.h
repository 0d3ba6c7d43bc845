// The exact Euclidean distance transform of Felzenszwalb and Huttenlocher (Theory of Computing 8, 2012).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Returns the squared distance from each voxel's centre to the nearest centre of a set voxel, in voxels². It is +∞ if
/// none is set.
///
/// Three passes compute lower envelopes of parabolas, one per axis: O(voxels). x runs fastest. For grids with a
/// diagonal under 4096 voxels the result is exact (integers below 2²⁴).
/// @param set  size.prod() entries; non-zero means set
std::vector<float> squared_distance_transform(const std::vector<std::uint8_t>& set, const Eigen::Vector3i& size);

}  // namespace tern
