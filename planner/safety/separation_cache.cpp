#include "planner/safety/separation_cache.h"

#include <algorithm>

namespace tern {

void SeparationCache::Store::clear() {
  for (auto& block : blocks_) block.clear();
  block_ = 0;
}

std::span<const CentredBox> SeparationCache::Store::keep(std::span<const CentredBox> boxes) {
  constexpr std::size_t kLeast = 1024;  // boxes of a block
  const auto has_room = [&](const std::vector<CentredBox>& block) {
    return block.capacity() - block.size() >= boxes.size();
  };
  while (block_ < blocks_.size() && !has_room(blocks_[block_])) ++block_;
  if (block_ == blocks_.size()) blocks_.emplace_back().reserve(std::max(kLeast, boxes.size()));
  std::vector<CentredBox>& block = blocks_[block_];
  const std::size_t first = block.size();
  block.insert(block.end(), boxes.begin(), boxes.end());
  return {block.data() + first, boxes.size()};
}

void SeparationCache::start(const SweptObstacles& obstacles) {
  obstacles_ = &obstacles;
  last_blocker_.assign(idx(obstacles.intervals()), -1);
  slots_.assign(idx(obstacles.slots()), -1);
  made_used_ = 0;
  boxes_.clear();
  hulls_used_ = 0;
  hulls_made_ = 0;
}

SeparationCache::Slot& SeparationCache::slot_of(const Neighbour& neighbour) {
  int& at = slots_[idx(neighbour.slot)];
  if (at < 0) {
    at = static_cast<int>(made_used_++);
    if (made_.size() < made_used_) {
      made_.emplace_back();
    } else {
      made_[idx(at)] = Slot{};
    }
  }
  return made_[idx(at)];
}

SeparationCache::Part& SeparationCache::part_of(const Neighbour& neighbour, const TimePart& part) {
  return slot_of(neighbour).parts[obstacles_->obstacle(neighbour).moves() ? part.slot() : 0];
}

SeparationCache::Part& SeparationCache::swept_part_of(const Neighbour& neighbour, const TimePart& part) {
  Part& made = part_of(neighbour, part);
  if (made.boxes.empty()) {
    scratch_.clear();
    obstacles_->append_sweep(scratch_, neighbour, part);
    made.boxes = boxes_.keep(scratch_);
  }
  return made;
}

SeparationCache::Sweep SeparationCache::sweep(const Neighbour& neighbour, const TimePart& part) {
  Part& made = swept_part_of(neighbour, part);
  return {made.boxes, made.direction};
}

const Points& SeparationCache::hull(const Neighbour& neighbour, const TimePart& part) {
  Part& made = swept_part_of(neighbour, part);
  if (made.hull < 0) {
    made.hull = static_cast<int>(hulls_used_++);
    if (hulls_.size() < hulls_used_) hulls_.emplace_back();
    hulls_[idx(made.hull)] = obstacles_->hull(neighbour, made.boxes);
    hulls_made_ += obstacles_->hull_is_made_by_cgal(neighbour) ? 1 : 0;
  }
  return hulls_[idx(made.hull)];
}

const Box& SeparationCache::part_box(const Neighbour& neighbour, const TimePart& part) {
  Box& box = part_of(neighbour, part).box;
  if (box.isEmpty()) box = obstacles_->part_box(neighbour, part);
  return box;
}

const CentredBox& SeparationCache::at_quarter(int interval, const Neighbour& neighbour, int k) {
  Slot& slot = slot_of(neighbour);
  if (!slot.has_quarters) {
    for (int i = 0; i < SweptObstacles::kQuarters; ++i) {
      slot.quarters[idx(i)] = obstacles_->box_at_quarter(interval, neighbour, i);
    }
    slot.has_quarters = true;
  }
  return slot.quarters[idx(k)];
}

}  // namespace tern
