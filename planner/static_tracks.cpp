#include "planner/static_tracks.h"

#include <algorithm>
#include <set>

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
  std::set<std::int64_t> named;
  for (const Track& track : set.tracks) {
    if (track.kind != TrackKind::Static) continue;
    const Box box = track.bounds(track.motion.start, track.motion.start);
    Known& known = by_id_[track.id];
    changed = changed || known.sets == 0 || known.box.min() != box.min() || known.box.max() != box.max();
    known = {box, std::min(known.sets + 1, kRememberedAfter)};
    named.insert(track.id);
  }
  const auto forgotten = std::erase_if(
      by_id_, [&](const auto& entry) { return entry.second.sets < kRememberedAfter && !named.contains(entry.first); });
  if (!changed && forgotten == 0) return false;
  boxes_.clear();
  for (const auto& [id, known] : by_id_) boxes_.push_back(known.box);
  digest_ = digest_of(boxes_);
  return true;
}

}  // namespace tern
