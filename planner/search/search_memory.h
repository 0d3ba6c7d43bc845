// Memory of the search, kept from call to call so that it allocates nothing. It never changes a result.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "planner/search/step_reach.h"

namespace tern {

/// A search node: a control point q_l with its index and its parent.
struct SearchNode {
  Vec3 q = Vec3::Zero();
  Vec3 v = Vec3::Zero();  ///< v_{l−1}, the velocity control point that leads to it, m/s
  Vec3 a = Vec3::Zero();  ///< a_{l−2}, the acceleration at the knot before it, m/s²
  int parent = -1;        ///< index of the parent; −1 for the root
  int l = 0;              ///< index of the control point
  double g = 0.0;         ///< λ_g · length + accumulated semantics
};

/// The key of an open node in the order of expansion: (band, f in steps, depth, f, index).
struct SearchEntry {
  std::int64_t band;
  std::int64_t f_step;
  double f;
  int depth_left;
  int node;
  [[nodiscard]] bool before(const SearchEntry& o) const {
    if (band != o.band) return band < o.band;
    if (f_step != o.f_step) return f_step < o.f_step;
    if (depth_left != o.depth_left) return depth_left < o.depth_left;
    if (f != o.f) return f < o.f;
    return node < o.node;
  }
};

/// A sampled velocity of one axis, and the bounds of the remaining displacement with it.
struct SearchAxisSample {
  double v;
  AxisReach::Interval ahead;
};

/// A set of keys, by open addressing; clear() is O(1) and keeps the memory.
class KeySet {
 public:
  void clear() {
    size_ = 0;
    if (++generation_ == 0) {
      slots_.assign(slots_.size(), {});
      generation_ = 1;
    }
  }
  [[nodiscard]] bool contains(std::uint64_t key) const {
    return !slots_.empty() && slots_[find(key)].generation == generation_;
  }
  void insert(std::uint64_t key) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[find(key)];
    if (slot.generation == generation_) return;
    slot = {key, generation_};
    ++size_;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t generation = 0;  ///< the slot is filled if this equals the set's
  };
  /// Returns the slot of the key, or the one in which it would be put.
  [[nodiscard]] std::size_t find(std::uint64_t key) const {
    std::uint64_t h = key * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
    std::size_t at = h & (slots_.size() - 1);
    while (slots_[at].generation == generation_ && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 1024 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.generation == generation_) slots_[find(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;  ///< their number is a power of two
  std::uint32_t generation_ = 1;
  std::size_t size_ = 0;
};

struct SearchMemory {
  std::vector<SearchNode> nodes;
  std::vector<SearchEntry> open;  ///< a heap of the open nodes
  KeySet closed;
  std::array<std::vector<SearchAxisSample>, 3> samples;
  StepReach reach;
};

}  // namespace tern
