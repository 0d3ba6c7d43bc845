#include "planner/static_tracks.h"

#include "core/base/digest.h"

namespace tern {

std::uint64_t digest_of(const std::vector<Box>& boxes) {
  std::uint64_t h = kDigestSeed;
  for (const Box& b : boxes) {
    const double numbers[6] = {b.min().x(), b.min().y(), b.min().z(), b.max().x(), b.max().y(), b.max().z()};
    h = digest({reinterpret_cast<const char*>(numbers), sizeof(numbers)}, h);
  }
  return h;
}

StaticTracks::StaticTracks() : digest_(digest_of({})) {}

bool StaticTracks::add(const TrackSet& set) {
  bool changed = false;
  if (set.header.name.sender_epoch_us != epoch_us_) {
    epoch_us_ = set.header.name.sender_epoch_us;
    first_set_ = set.batch.set;
    changed = !by_id_.empty();
    by_id_.clear();
  }
  for (const Track& track : set.tracks) {
    if (track.kind != TrackKind::Static) continue;
    const Box box = track.bounds(track.motion.start, track.motion.start);
    const auto [at, is_new] = by_id_.emplace(track.id, box);
    if (is_new || (at->second.min() == box.min() && at->second.max() == box.max())) {
      changed = changed || is_new;
      continue;
    }
    at->second = box;
    changed = true;
  }
  if (!changed) return false;
  boxes_.clear();
  for (const auto& [id, box] : by_id_) boxes_.push_back(box);
  digest_ = digest_of(boxes_);
  return true;
}

}  // namespace tern
