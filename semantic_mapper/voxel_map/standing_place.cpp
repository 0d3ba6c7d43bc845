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

bool is_at_the_edge(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels, const Body& body, const Vec3& p) {
  for (int k = 0; k < 27; ++k) {
    const Eigen::Vector3i step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (voxels_within(0.0, grid, labels, body, p + grid.resolution * step.cast<double>()).empty()) return true;
  }
  return false;
}

/// Whether of several layers of the body only the lowest one overlaps voxels. @param overlapped  ascending
bool stands_on(const std::vector<std::int64_t>& overlapped, const VoxelGrid& grid, const Body& body, const Vec3& p) {
  const Box box = grown(body_box(body), Vec3::Constant(-kOverlapTolerance));
  const int lowest = grid.cell_of(p + box.min()).z();
  return grid.cell_of(p + box.max()).z() > lowest && grid.cell(overlapped.back()).z() == lowest;
}

}  // namespace

std::vector<std::int64_t> voxels_met(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels, const Body& body,
                                     const Vec3& p) {
  const std::vector<std::int64_t> overlapped = voxels_within(0.0, grid, labels, body, p);
  if (overlapped.empty() || !is_at_the_edge(grid, labels, body, p)) return {};
  return stands_on(overlapped, grid, body, p) ? voxels_stood_in(grid, labels, body, p) : overlapped;
}

std::vector<std::int64_t> voxels_overlapped(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                            const Body& body, const Vec3& p) {
  return voxels_within(0.0, grid, labels, body, p);
}

std::vector<std::int64_t> voxels_stood_in(const VoxelGrid& grid, const std::vector<VoxelLabel>& labels,
                                          const Body& body, const Vec3& p) {
  const std::vector<std::int64_t> overlapped = voxels_within(0.0, grid, labels, body, p);
  if (overlapped.empty() || !is_at_the_edge(grid, labels, body, p)) return {};
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
