#include "planner/static_tracks.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/digest.h"

namespace tern {
namespace {

bool is_at_rest(const Track& track) {
  const UTime from = track.motion.start, later = std::min(from + Duration{1'000'000}, track.motion.end());
  return (track.motion.sample(later).p - track.motion.sample(from).p).norm() <= StaticTracks::kRestingWay;
}

/// While an obstacle comes into view, one face of its box moves; when it moves, both do.
bool has_moved(const Box& from, const Box& to) {
  const Vec3 low = to.min() - from.min(), high = to.max() - from.max();
  return low.cwiseMin(high).maxCoeff() > StaticTracks::kMovedAway ||
         low.cwiseMax(high).minCoeff() < -StaticTracks::kMovedAway;
}

}  // namespace

Box rounded_out(const Box& box, double step, double tolerance) {
  const auto outwards = [&](double x) { return step * std::ceil((x - tolerance) / step); };
  return {-(-box.min()).unaryExpr(outwards), box.max().unaryExpr(outwards)};
}

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
    changed = !by_id_.empty() || !obstacles_.resting.empty() || obstacles_.map_margin > 0.0;
    by_id_.clear();
    resting_.clear();
    obstacles_.map_margin = 0.0;
  }
  changed = add_static(set) || changed;
  changed = add_resting(set) || changed;
  changed = add_map_margin(set) || changed;
  if (!changed) return false;
  obstacles_.fixed.clear();
  for (const auto& [id, known] : by_id_) obstacles_.fixed.push_back(known.box);
  obstacles_.resting = wide_boxes();
  std::vector<Box> digested = obstacles_.all();
  if (obstacles_.map_margin > 0.0) digested.push_back(box_around(Vec3::Zero(), Vec3::Constant(obstacles_.map_margin)));
  const std::uint64_t before = std::exchange(digest_, digest_of(digested));
  return digest_ != before;
}

/// Boxes that touch are joined from the first one of each group on.
std::vector<Box> StaticTracks::wide_boxes() const {
  std::vector<const Resting*> rested;
  for (const auto& [id, resting] : resting_) {
    if (resting.box) rested.push_back(&resting);
  }
  std::vector<std::size_t> group(rested.size(), rested.size());
  std::vector<Box> extents;  // of each group
  for (std::size_t first = 0; first < rested.size(); ++first) {
    if (group[first] != rested.size()) continue;
    group[first] = extents.size();
    Box extent = rested[first]->bare;
    for (std::vector<std::size_t> next{first}; !next.empty();) {
      const std::size_t one = next.back();
      next.pop_back();
      for (std::size_t other = 0; other < rested.size(); ++other) {
        if (group[other] != rested.size() || !rested[one]->box->intersects(*rested[other]->box)) continue;
        group[other] = extents.size();
        extent.extend(rested[other]->bare);
        next.push_back(other);
      }
    }
    extents.push_back(extent);
  }
  std::vector<Box> wide;
  for (std::size_t k = 0; k < rested.size(); ++k) {
    if (extents[group[k]].sizes().head<2>().maxCoeff() >= kWide) wide.push_back(*rested[k]->box);
  }
  return wide;
}

bool StaticTracks::add_static(const TrackSet& set) {
  bool changed = false;
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
  return changed || forgotten > 0;
}

bool StaticTracks::add_resting(const TrackSet& set) {
  bool changed = false;
  for (const Track& track : set.tracks) {
    if (track.kind != TrackKind::Estimated) continue;
    const Box place = box_around(track.motion.sample(track.motion.start).p, track.half_extents);
    const auto known = resting_.find(track.id);
    const bool is_gone = known != resting_.end() && has_moved(known->second.place, place);
    if (known != resting_.end() && (is_gone || !is_at_rest(track))) {
      changed = changed || known->second.box.has_value();
      resting_.erase(known);
    }
    if (!is_at_rest(track)) continue;
    const Vec3& alpha = track.alpha.front();
    Resting& resting = resting_.try_emplace(track.id, Resting{set.made_at, {}, place, alpha, {}, place}).first->second;
    resting.seen = set.made_at;
    resting.alpha = resting.alpha.cwiseMin(alpha);
    if (set.made_at - resting.since >= kRestedFor) changed = take_box(track, resting) || changed;
  }
  std::erase_if(resting_, [&](const auto& entry) {
    const bool is_omitted = entry.second.seen + kOmittedFor < set.made_at;
    changed = changed || (is_omitted && entry.second.box.has_value());
    return is_omitted;
  });
  return changed;
}

bool StaticTracks::add_map_margin(const TrackSet& set) {
  const double margin = set.pose_error ? set.pose_error->margin(set.pose_error->position) : 0.0;
  const double kept = obstacles_.map_margin;
  if (margin <= kept && kept - margin < 3.0 * kMarginStep && (margin > 0.0 || kept == 0.0)) return false;
  obstacles_.map_margin = kMarginStep * std::ceil(margin / kMarginStep);
  return true;
}

bool StaticTracks::take_box(const Track& track, Resting& resting) {
  const Vec3 p = track.motion.sample(track.motion.start).p;
  const Box hull = box_around(p, track.half_extents + resting.alpha);
  const bool is_much_smaller = resting.box && (resting.box->sizes() - hull.sizes()).maxCoeff() > kMuchSmaller;
  if (resting.box && resting.box->contains(hull) && !is_much_smaller) return false;
  resting.box = rounded_out(hull, kBoxStep);
  resting.bare = box_around(p, track.half_extents);
  return true;
}

}  // namespace tern
