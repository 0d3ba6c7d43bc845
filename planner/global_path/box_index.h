// A spatial index over fixed boxes: finds the boxes that intersect a region or a segment.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// Least distance of a path from every box, m. It exceeds the rounding of the slab test (1e-11 m at 10⁴ m from the
/// origin), and is too small to matter to a vehicle.
inline constexpr double kPathClearance = 1e-6;

/// Returns whether the closed segment ab intersects the closed box, by the slab method. It is exact up to rounding of
/// the segment's parameter.
bool segment_meets_box(const Vec3& a, const Vec3& b, const Box& box);

/// Returns the part of a box that blocks a path from p. If p is outside, this is the box. If p is inside, it is the
/// part that lies deeper than p; at the centre it is empty. A path from the margin of an obstacle may thus leave the
/// margin or follow it, but not cross the obstacle.
Box core_beyond(const Box& box, const Vec3& p);

/// A tree of bounding boxes, split at the median of the longest axis, with ties broken by index. It is immutable, and
/// queries do not allocate.
class BoxIndex {
 public:
  BoxIndex() = default;
  /// Builds the index in O(n log n). Empty boxes are allowed; queries never find them.
  explicit BoxIndex(std::vector<Box> boxes);

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  /// Calls visit(index) for every box that intersects the closed region, in an order that depends on the boxes alone.
  /// Stops as soon as visit returns true.
  /// @return whether it was stopped
  template <class Visit>
  bool visit(const Box& region, Visit&& visit) const {
    return walk([&](const Box& box) { return box.intersects(region); }, visit);
  }

  /// Returns the indices of the boxes that intersect the closed region, ascending.
  [[nodiscard]] std::vector<std::int32_t> query(const Box& region) const;
  /// Writes the same to `found`, whose memory is kept.
  void query(const Box& region, std::vector<std::int32_t>& found) const;

  /// Returns whether the closed segment comes nearer than kPathClearance (per axis) to any box.
  [[nodiscard]] bool blocks(const Vec3& a, const Vec3& b) const;

  /// The same, except that a box that contains `start` (to kPathClearance) blocks only with the part core_beyond().
  [[nodiscard]] bool blocks(const Vec3& a, const Vec3& b, const Vec3& start) const;

  /// Returns whether p is within kPathClearance (per axis) of any box.
  [[nodiscard]] bool covers(const Vec3& p) const { return blocks(p, p); }

 private:
  struct Node {
    Box box;
    std::int32_t first =
        0;  ///< leaf: start of its range in order_; inner node: right child (the left child follows its parent)
    std::int32_t count = 0;  ///< number of boxes of a leaf; 0 for an inner node
  };
  static constexpr int kLeafSize = 4;
  static constexpr int kMaxDepth = 64;

  void build(std::int32_t begin, std::int32_t end);

  template <class Meets, class Visit>
  bool walk(const Meets& meets, Visit&& visit) const {
    if (nodes_.empty()) return false;
    std::array<std::int32_t, kMaxDepth> stack;
    int top = 0;
    stack[0] = 0;
    while (top >= 0) {
      const auto at = idx(stack[idx(top--)]);
      const Node& node = nodes_[at];
      if (!meets(node.box)) continue;
      if (node.count == 0) {
        stack[idx(++top)] = node.first;
        stack[idx(++top)] = static_cast<std::int32_t>(at) + 1;
        continue;
      }
      for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
        const std::int32_t i = order_[idx(k)];
        if (meets(boxes_[idx(i)]) && visit(i)) return true;
      }
    }
    return false;
  }

  std::vector<Box> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace tern
