#include "semantic_mapper/voxel_map/octomap_voxels.h"

#include <algorithm>

namespace tern {
namespace {

/// A tolerance, in voxels: a leaf that touches a voxel does not overlap it, in spite of rounding.
constexpr double kTouch = 1e-6;

}  // namespace

void paint_octomap(const OctoMapFile& octomap, VoxelPainter& painter) {
  const VoxelGrid grid = painter.grid();
  const std::uint8_t occupied = painter.class_index(kUnlabelled);
  const Vec3 last = (grid.size - Eigen::Vector3i::Ones()).cast<double>();
  for (const OctoLeaf& leaf : octomap.leaves) {
    const Box box = octomap.box(leaf);
    const Vec3 min = (box.min() - grid.origin) / grid.resolution;
    const Vec3 max = (box.max() - grid.origin) / grid.resolution;
    // Voxel i overlaps the leaf if i + 1 > min and i < max. Its centre is in the leaf if i + ½ ≥ min and i + ½ < max.
    const double centre = leaf.is_occupied ? 0.0 : 0.5;
    Vec3 low = (min.array() + kTouch).floor();
    if (!leaf.is_occupied) low = (min.array() - centre - kTouch).ceil();
    low = low.cwiseMax(0.0);
    const Vec3 high = Vec3((max.array() - centre - kTouch).ceil() - 1.0).cwiseMin(last);
    if ((low.array() > high.array()).any()) continue;
    const Eigen::Vector3i from = low.cast<int>();
    const Eigen::Vector3i to = high.cast<int>();
    const VoxelLabel label = leaf.is_occupied ? VoxelLabel::Occupied : VoxelLabel::Free;
    for (int z = from.z(); z <= to.z(); ++z) {
      for (int y = from.y(); y <= to.y(); ++y) {
        for (int x = from.x(); x <= to.x(); ++x) {
          painter.paint(grid.index({x, y, z}), label, leaf.is_occupied ? occupied : std::uint8_t{0});
        }
      }
    }
  }
}

}  // namespace tern
