#include "semantic_mapper/voxel_map/standing_place.h"

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "core/world/body.h"

namespace tern {
namespace {

using Cell = Eigen::Vector3i;

/// Returns the occupied voxels nearer to the body at p than `room`; for 0 those that it overlaps.
std::vector<std::int64_t> voxels_within(double room, const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                        const Body& body, const Vec3& p) {
  std::vector<std::int64_t> voxels;
  const Points body_at_p = body.vertices.colwise() + p;
  const Box reach = grown(body_box(body), Vec3::Constant(room));
  const Cell low = grid.cell_of(p + reach.min()).cwiseMax(0);
  const Cell high = grid.cell_of(p + reach.max()).cwiseMin(grid.size - Cell::Ones());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const std::int64_t index = grid.index({x, y, z});
        if (labels[idx(index)] != VoxelLabel::Occupied) continue;
        const Points core = box_corners(grown(grid.box({x, y, z}), Vec3::Constant(-kOverlapTolerance)));
        // Where polytopes overlap, their distance is 0 but for rounding.
        if (distance(core, body_at_p) < body.radius + room + 0.5 * kOverlapTolerance) voxels.push_back(index);
      }
    }
  }
  return voxels;
}

}  // namespace

std::vector<std::int64_t> voxels_overlapped(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                            const Body& body, const Vec3& p) {
  return voxels_within(0.0, grid, labels, body, p);
}

std::vector<std::int64_t> voxels_stood_in(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                          const Body& body, const Vec3& p) {
  const std::vector<std::int64_t> overlapped = voxels_within(0.0, grid, labels, body, p);
  if (overlapped.empty()) return {};
  bool is_at_the_edge = false;
  for (int k = 0; k < 27 && !is_at_the_edge; ++k) {
    const Vec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    is_at_the_edge = voxels_within(0.0, grid, labels, body, p + grid.resolution * step).empty();
  }
  if (!is_at_the_edge) return {};
  std::vector<std::int64_t> voxels = voxels_within(0.5 * grid.resolution, grid, labels, body, p);
  const int lowest = grid.cell(overlapped.front()).z();  // ascending: z runs slowest
  const int highest = grid.cell(overlapped.back()).z();
  std::erase_if(voxels, [&](std::int64_t voxel) {
    const int z = grid.cell(voxel).z();
    return z < lowest || z > highest;
  });
  return voxels;
}

}  // namespace tern
