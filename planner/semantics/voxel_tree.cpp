#include "planner/semantics/voxel_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tern {

VoxelTree::VoxelTree(const VoxelMap& map, const VoxelKind& kind) : grid_(map.grid) {
  std::size_t i = 0;
  for (int z = 0; z < grid_.size.z(); ++z) {
    for (int y = 0; y < grid_.size.y(); ++y) {
      for (int x = 0; x < grid_.size.x(); ++x, ++i) {
        if (kind.has(map, i)) voxels_.emplace_back(x, y, z);
      }
    }
  }
  if (!voxels_.empty()) build(0, static_cast<std::int32_t>(voxels_.size()));
}

VoxelTree::Node VoxelTree::measure(std::int32_t begin, std::int32_t end) const {
  using Sum = Eigen::Matrix<std::int64_t, 3, 1>;
  Sum sum = Sum::Zero();
  Eigen::Matrix<std::int64_t, 3, 3> squares = Eigen::Matrix<std::int64_t, 3, 3>::Zero();
  for (std::int32_t k = begin; k < end; ++k) {
    const Sum v = voxels_[idx(k)].cast<std::int64_t>();
    sum += v;
    squares += v * v.transpose();
  }
  Node node;
  node.weight = static_cast<double>(end - begin);
  node.first = begin;
  node.count = end - begin;
  node.centroid = sum.cast<double>() / node.weight;
  node.covariance = squares.cast<double>() / node.weight - node.centroid * node.centroid.transpose();
  node.trace = std::max(0.0, node.covariance.trace());
  double far2 = 0.0;
  for (std::int32_t k = begin; k < end; ++k) {
    far2 = std::max(far2, (voxels_[idx(k)].cast<double>() - node.centroid).squaredNorm());
  }
  node.radius = std::sqrt(far2);
  return node;
}

void VoxelTree::build(std::int32_t begin, std::int32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.push_back(measure(begin, end));
  if (end - begin <= kLeafSize) return;
  Cell low = voxels_[idx(begin)];
  Cell high = low;
  for (std::int32_t k = begin; k < end; ++k) {
    low = low.cwiseMin(voxels_[idx(k)]);
    high = high.cwiseMax(voxels_[idx(k)]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  // Distinct voxels: the longest side spans at least two, so both halves are non-empty.
  const int middle = low[axis] + (high[axis] - low[axis]) / 2;
  const auto split =
      std::partition(voxels_.begin() + begin, voxels_.begin() + end, [&](const Cell& v) { return v[axis] <= middle; });
  const auto mid = static_cast<std::int32_t>(split - voxels_.begin());
  build(begin, mid);
  nodes_[at].right = static_cast<std::int32_t>(nodes_.size());
  build(mid, end);
}

double VoxelTree::mean_distance(const Vec3& p, double error) const {
  constexpr double kThirdOrder = 0.19245008972987526;  // (1/6)(2/√3)
  const Vec3 x = (p - grid_.origin) / grid_.resolution - Vec3::Constant(0.5);
  const double allowed = error / grid_.resolution;
  double sum = 0.0;
  // Each level halves the longest side, of at most 2³¹ voxels in three axes: never deeper than 93.
  std::array<std::int32_t, 96> stack;
  int top = 0;
  stack[0] = 0;
  while (top >= 0) {
    const std::int32_t at = stack[idx(top--)];
    const Node& node = nodes_[idx(at)];
    const Vec3 offset = x - node.centroid;
    const double distance2 = offset.squaredNorm();
    const double distance = std::sqrt(distance2);
    const double gap = distance - node.radius;
    if (gap > 0.0 && kThirdOrder * node.radius * node.trace <= allowed * gap * gap) {
      const double along = offset.dot(node.covariance * offset) / distance2;
      sum += node.weight * (distance + 0.5 * (node.trace - along) / distance);
    } else if (node.right == 0) {
      for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
        sum += (x - voxels_[idx(k)].cast<double>()).norm();
      }
    } else {
      stack[idx(++top)] = node.right;
      stack[idx(++top)] = at + 1;
    }
  }
  return grid_.resolution * sum / static_cast<double>(voxels_.size());
}

}  // namespace tern
