#include "core/world/fence_voxels.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// Where the square of a column of voxels lies.
enum class Side : std::uint8_t { Outside, Crossed, Inside };

/// A column per (x, y): x runs fastest.
using Columns = std::vector<Side>;

/// The columns of one row whose squares overlap [low, high] by more than a touch.
void cross(double low, double high, const VoxelGrid& grid, Side* row) {
  const double x0 = (low - kFenceTouch - grid.origin.x()) / grid.resolution;
  const double x1 = (high + kFenceTouch - grid.origin.x()) / grid.resolution;
  const double touch = 2.0 * kFenceTouch / grid.resolution;
  const int last = grid.size.x() - 1;
  const int from = static_cast<int>(std::clamp(std::floor(x0 + touch), 0.0, static_cast<double>(last) + 1.0));
  const int to = static_cast<int>(std::clamp(std::ceil(x1 - touch) - 1.0, -1.0, static_cast<double>(last)));
  for (int x = from; x <= to; ++x) row[x] = Side::Crossed;
}

/// One row: sides that pass through its strip cross columns; the others are inside by the even-odd rule at its middle.
void classify_row(const FencePolygon& polygon, const VoxelGrid& grid, int y, Side* row) {
  const double low = grid.origin.y() + grid.resolution * y + kFenceTouch;
  const double high = low + grid.resolution - 2.0 * kFenceTouch, middle = 0.5 * (low + high);
  std::vector<double> crossings;
  const std::size_t count = polygon.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d &a = polygon.corners[k], &b = polygon.corners[(k + 1) % count];
    if ((a.y() > middle) != (b.y() > middle)) {
      crossings.push_back(a.x() + (middle - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    if (std::max(a.y(), b.y()) <= low || std::min(a.y(), b.y()) >= high) continue;
    const auto at = [&](double height) {
      if (a.y() == b.y()) return a.x();
      return a.x() + std::clamp((height - a.y()) / (b.y() - a.y()), 0.0, 1.0) * (b.x() - a.x());
    };
    const double x0 = a.y() == b.y() ? a.x() : at(low), x1 = a.y() == b.y() ? b.x() : at(high);
    cross(std::min(x0, x1), std::max(x0, x1), grid, row);
  }
  std::sort(crossings.begin(), crossings.end());
  std::size_t passed = 0;
  for (int x = 0; x < grid.size.x(); ++x) {
    const double centre = grid.origin.x() + grid.resolution * (x + 0.5);
    while (passed < crossings.size() && crossings[passed] < centre) ++passed;
    if (row[x] == Side::Outside && passed % 2 == 1) row[x] = Side::Inside;
  }
}

void classify_row(const FenceCircle& circle, const VoxelGrid& grid, int y, Side* row) {
  for (int x = 0; x < grid.size.x(); ++x) {
    const Vec3 centre = grid.centre({x, y, 0});
    const Eigen::Array2d off = (centre.head<2>() - circle.centre).array().abs();
    const Eigen::Array2d near = (off - 0.5 * grid.resolution).max(0.0), far = off + 0.5 * grid.resolution;
    if (far.matrix().norm() <= circle.radius + kFenceTouch) {
      row[x] = Side::Inside;
    } else if (near.matrix().norm() < circle.radius - kFenceTouch) {
      row[x] = Side::Crossed;
    }
  }
}

Columns classify(const Fence& fence, const VoxelGrid& grid) {
  Columns columns(idx(grid.size.x()) * idx(grid.size.y()), Side::Outside);
  for (int y = 0; y < grid.size.y(); ++y) {
    Side* row = &columns[idx(grid.size.x()) * idx(y)];
    std::visit([&](const auto& shape) { classify_row(shape, grid, y, row); }, fence.shape);
  }
  return columns;
}

/// Labels the voxels of a layer whose columns satisfy `is_meant`.
template <class IsMeant>
void label_layer(const Columns& columns, const VoxelGrid& grid, int z, VoxelLabel label, const IsMeant& is_meant,
                 std::vector<VoxelLabel>& labels) {
  VoxelLabel* layer = &labels[idx(grid.index({0, 0, z}))];
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (is_meant(columns[k])) layer[k] = label;
  }
}

Box bounds_of(const Fence& fence) {
  Eigen::AlignedBox2d flat;
  if (const auto* polygon = std::get_if<FencePolygon>(&fence.shape)) {
    for (const Eigen::Vector2d& corner : polygon->corners) flat.extend(corner);
  } else {
    const auto& circle = std::get<FenceCircle>(fence.shape);
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(circle.radius);
    flat = Eigen::AlignedBox2d(circle.centre - reach, circle.centre + reach);
  }
  return {Vec3(flat.min().x(), flat.min().y(), fence.floor), Vec3(flat.max().x(), flat.max().y(), fence.ceiling)};
}

}  // namespace

std::vector<VoxelLabel> fence_labels(const std::vector<Fence>& fences, const VoxelGrid& grid) {
  const bool has_inclusion = std::any_of(fences.begin(), fences.end(), [](const Fence& f) { return f.is_inclusion; });
  std::vector<VoxelLabel> labels(idx(grid.voxels()), has_inclusion ? VoxelLabel::Occupied : VoxelLabel::Unknown);
  if (labels.empty()) return labels;
  for (const bool inclusion : {true, false}) {
    for (const Fence& fence : fences) {
      if (fence.is_inclusion != inclusion) continue;
      const Columns columns = classify(fence, grid);
      for (int z = 0; z < grid.size.z(); ++z) {
        const double low = grid.origin.z() + grid.resolution * z, high = low + grid.resolution;
        const bool is_within = low >= fence.floor - kFenceTouch && high <= fence.ceiling + kFenceTouch;
        const bool overlaps = high > fence.floor + kFenceTouch && low < fence.ceiling - kFenceTouch;
        if (inclusion && is_within) {
          label_layer(
              columns, grid, z, VoxelLabel::Unknown, [](Side s) { return s == Side::Inside; }, labels);
        } else if (!inclusion && overlaps) {
          label_layer(
              columns, grid, z, VoxelLabel::Occupied, [](Side s) { return s != Side::Outside; }, labels);
        }
      }
    }
  }
  return labels;
}

Box fenced_box(const std::vector<Fence>& fences, const Box& flight_box, double resolution) {
  Box box;
  for (const Fence& fence : fences) {
    const double wall = fence.is_inclusion ? resolution : 0.0;
    const Box bounds = grown(bounds_of(fence), Vec3::Constant(wall));
    const Box inside = flight_box.isEmpty() ? bounds : bounds.intersection(flight_box);
    if (!inside.isEmpty()) box.extend(inside);
  }
  return box;
}

}  // namespace tern
