#include "planner/global_path/box_index.h"

#include <algorithm>
#include <utility>

namespace tern {
namespace {

/// A segment prepared for slab tests against many boxes.
class Slabs {
 public:
  Slabs(const Vec3& a, const Vec3& b) : a_(a) {
    const Vec3 d = b - a;
    for (int i = 0; i < 3; ++i) {
      flat_[i] = d[i] == 0.0;
      inverse_[i] = flat_[i] ? 0.0 : 1.0 / d[i];
    }
  }

  /// Returns whether it intersects the closed box grown by `growth`.
  [[nodiscard]] bool meets(const Box& box, double growth) const {
    double enter = 0.0;
    double leave = 1.0;
    for (int i = 0; i < 3; ++i) {
      const double low = box.min()[i] - growth - a_[i];
      const double high = box.max()[i] + growth - a_[i];
      if (flat_[i]) {
        if (low > 0.0 || high < 0.0) return false;
        continue;
      }
      const double t0 = low * inverse_[i];
      const double t1 = high * inverse_[i];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave;
  }

 private:
  Vec3 a_;
  Vec3 inverse_;
  bool flat_[3];
};

}  // namespace

bool segment_meets_box(const Vec3& a, const Vec3& b, const Box& box) { return Slabs(a, b).meets(box, 0.0); }

Box core_beyond(const Box& box, const Vec3& p) {
  const double outside = std::max((box.min() - p).maxCoeff(), (p - box.max()).maxCoeff());
  return outside > kPathClearance ? box : grown(box, Vec3::Constant(outside - 2.0 * kPathClearance));
}

BoxIndex::BoxIndex(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  order_.reserve(boxes_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].isEmpty()) order_.push_back(static_cast<std::int32_t>(i));
  }
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()));
}

void BoxIndex::build(std::int32_t begin, std::int32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Box bounds;
  Box centres;
  for (std::int32_t k = begin; k < end; ++k) {
    const Box& box = boxes_[idx(order_[idx(k)])];
    bounds.extend(box);
    centres.extend(box.center());
  }
  nodes_[at].box = bounds;
  if (end - begin <= kLeafSize) {
    nodes_[at].first = begin;
    nodes_[at].count = end - begin;
    return;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  const auto key = [&](std::int32_t i) {
    const Box& box = boxes_[idx(i)];
    return std::pair(box.min()[axis] + box.max()[axis], i);
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
  build(begin, middle);
  nodes_[at].first = static_cast<std::int32_t>(nodes_.size());
  build(middle, end);
}

std::vector<std::int32_t> BoxIndex::query(const Box& region) const {
  std::vector<std::int32_t> found;
  query(region, found);
  return found;
}

void BoxIndex::query(const Box& region, std::vector<std::int32_t>& found) const {
  found.clear();
  visit(region, [&](std::int32_t i) {
    found.push_back(i);
    return false;
  });
  std::sort(found.begin(), found.end());
}

bool BoxIndex::blocks(const Vec3& a, const Vec3& b) const {
  const Slabs slabs(a, b);
  return walk([&](const Box& box) { return slabs.meets(box, kPathClearance); }, [](std::int32_t) { return true; });
}

bool BoxIndex::blocks(const Vec3& a, const Vec3& b, const Vec3& start) const {
  const Slabs slabs(a, b);
  return walk([&](const Box& box) { return slabs.meets(box, kPathClearance); },
              [&](std::int32_t i) {
                const Box core = core_beyond(boxes_[idx(i)], start);
                return !core.isEmpty() && slabs.meets(core, kPathClearance);
              });
}

}  // namespace tern
