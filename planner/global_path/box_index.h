// A spatial index over fixed boxes: which ones meet a region, does a segment meet any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// A path keeps at least this far from every box, m. It is above the rounding of the slab test (1e-11 m at 10⁴ m from
/// the origin) and below anything that matters to a vehicle.
inline constexpr double kPathClearance = 1e-6;

/// Does the closed segment ab meet the closed box? Slab method; exact but for rounding in the last places of a
/// parameter.
bool segment_meets_box(const Vec3& a, const Vec3& b, const Box& box);

/// What of a box stands in the way of a path from p: all of it, or, if p lies in it, what lies deeper than p. So who is
/// in the margin of an obstacle leaves it, or goes along it, and does not go through. Empty if p is in its middle.
Box core_beyond(const Box& box, const Vec3& p);

/// A tree of bounding boxes (split at the median of the longest axis, ties by index). Immutable; queries do not
/// allocate.
class BoxIndex {
 public:
  BoxIndex() = default;
  /// O(n log n). Empty boxes are allowed and never found.
  explicit BoxIndex(std::vector<Box> boxes);

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  /// Calls visit(index of the box) for every box that meets the closed region, in an order fixed by the boxes alone.
  /// Stops when visit returns true.
  /// @return whether it was stopped
  template <class Visit>
  bool visit(const Box& region, Visit&& visit) const {
    return walk([&](const Box& box) { return box.intersects(region); }, visit);
  }

  /// The indices of the boxes that meet the closed region, ascending.
  [[nodiscard]] std::vector<std::int32_t> query(const Box& region) const;
  /// The same into `found`, which keeps its memory.
  void query(const Box& region, std::vector<std::int32_t>& found) const;

  /// Does the closed segment come nearer than kPathClearance (per axis) to any box?
  [[nodiscard]] bool blocks(const Vec3& a, const Vec3& b) const;

  /// The same, but of boxes that contain `start` (to kPathClearance) only the core beyond it blocks.
  [[nodiscard]] bool blocks(const Vec3& a, const Vec3& b, const Vec3& start) const;

  /// Is p within kPathClearance (per axis) of any box?
  [[nodiscard]] bool covers(const Vec3& p) const { return blocks(p, p); }

 private:
  struct Node {
    Box box;
    std::int32_t first = 0;  ///< leaf: first of order_; else the right child (the left one follows its parent)
    std::int32_t count = 0;  ///< leaf: > 0 boxes; 0: inner
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
