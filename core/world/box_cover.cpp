#include "core/world/box_cover.h"

#include <array>
#include <cstdint>
#include <utility>

namespace tern {
namespace {

using Cell = Eigen::Vector3i;

/// The voxels that no box covers yet.
class Remaining {
 public:
  Remaining(const VoxelGrid& grid, std::vector<bool> open) : grid_(grid), open_(std::move(open)) {}

  [[nodiscard]] bool has(std::size_t i) const { return open_[i]; }

  /// True if no box covers any voxel of low … high (inclusive).
  [[nodiscard]] bool full(const Cell& low, const Cell& high) const {
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        const auto row = idx(grid_.index({low.x(), y, z}));
        for (std::size_t i = row; i <= row + idx(high.x() - low.x()); ++i) {
          if (!open_[i]) return false;
        }
      }
    }
    return true;
  }

  void close(const Cell& low, const Cell& high) {
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) open_[idx(grid_.index({x, y, z}))] = false;
      }
    }
  }

  /// Returns the upper corner of the box that grows from `low`, one axis after the other.
  [[nodiscard]] Cell grow(const Cell& low, const std::array<int, 3>& axes) const {
    Cell high = low;
    for (const int axis : axes) {
      Cell from = low;
      Cell to = high;
      while (to[axis] + 1 < grid_.size[axis]) {
        from[axis] = to[axis] = to[axis] + 1;
        if (!full(from, to)) break;
        high[axis] = to[axis];
      }
    }
    return high;
  }

 private:
  const VoxelGrid& grid_;
  std::vector<bool> open_;
};

}  // namespace

std::vector<Box> cover_with_boxes(const VoxelGrid& grid, std::vector<bool> wanted) {
  constexpr std::array<std::array<int, 3>, 3> kOrders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};
  std::vector<Box> boxes;
  const std::size_t voxels = wanted.size();
  Remaining remaining(grid, std::move(wanted));
  for (std::size_t i = 0; i < voxels; ++i) {
    if (!remaining.has(i)) continue;
    const Cell low = grid.cell(static_cast<std::int64_t>(i));
    Cell best = low;
    std::int64_t best_volume = 0;
    for (const auto& axes : kOrders) {
      const Cell high = remaining.grow(low, axes);
      const std::int64_t volume = (high - low + Cell::Ones()).cast<std::int64_t>().prod();
      if (volume <= best_volume) continue;
      best = high;
      best_volume = volume;
    }
    remaining.close(low, best);
    boxes.emplace_back(grid.box(low).min(), grid.box(best).max());
  }
  return boxes;
}

std::vector<Box> cover_with_boxes(const VoxelMap& map, bool unknown_is_obstacle) {
  std::vector<bool> obstacle(map.labels.size());
  for (std::size_t i = 0; i < obstacle.size(); ++i) {
    const VoxelLabel label = map.labels[i];
    obstacle[i] = label == VoxelLabel::Occupied || (unknown_is_obstacle && label == VoxelLabel::Unknown);
  }
  return cover_with_boxes(map.grid, std::move(obstacle));
}

}  // namespace tern
