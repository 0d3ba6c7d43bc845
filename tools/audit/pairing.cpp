#include "tools/audit/pairing.h"

#include <set>
#include <tuple>
#include <vector>

#include "tools/audit/cubic.h"

namespace tern::audit {
namespace {

struct Near {
  double to_box, outside, to_centre;
  std::int64_t track, obstacle;
};

/// Returns the share of a box's volume that lies outside another.
double share_outside(const Box& box, const Box& other) {
  const double volume = box.volume();
  return volume > 0.0 && box.intersects(other) ? 1.0 - box.intersection(other).volume() / volume : 1.0;
}

bool is_nearer(const Near& a, const Near& b) {
  return std::tie(a.to_box, a.outside, a.to_centre, a.track, a.obstacle) <
         std::tie(b.to_box, b.outside, b.to_centre, b.track, b.obstacle);
}

/// Returns the sample nearest to t in time; null if none is within kUnknownFor.
const ObstacleHistory::Sample* sample_at(const ObstacleHistory& history, UTime t) {
  const auto& s = history.samples;
  const auto after = std::lower_bound(s.begin(), s.end(), t, [](const auto& a, UTime at) { return a.at < at; });
  const ObstacleHistory::Sample* nearest = nullptr;
  if (after != s.end() && after->at - t <= kUnknownFor) nearest = &*after;
  if (after == s.begin() || t - (after - 1)->at > kUnknownFor) return nearest;
  if (nearest == nullptr || t - (after - 1)->at < nearest->at - t) nearest = &*(after - 1);
  return nearest;
}

}  // namespace

bool Pairing::is_in_view(const Track& track, UTime made_at) const {
  if (record_.observations.empty() && record_.sightings.empty()) return true;
  return is_seen_in(record_.observations, track, made_at) || is_seen_in(record_.sightings, track, made_at);
}

bool Pairing::is_seen_in(const std::vector<ObservationSet>& all, const Track& track, UTime made_at) {
  const Curve first = curves_of(track.motion).front();
  auto set = std::upper_bound(all.begin(), all.end(), made_at, [](UTime t, const auto& o) { return t < o.at; });
  while (set != all.begin() && made_at - (--set)->at < kInViewFor) {
    const Vec3 p = first.p(0.0) - first.v(0.0) * (track.motion.start - set->at).seconds();
    for (const Detection& d : set->detections) {
      if (((d.position - p).cwiseAbs() - d.half_extents - track.half_extents).maxCoeff() <= 0.0) return true;
    }
  }
  return false;
}

const std::map<std::int64_t, PairedObstacle>& Pairing::pair(const TrackSet& set) {
  pairs_.clear();
  std::set<std::int64_t> taken;
  const auto give = [&](std::int64_t track, std::int64_t obstacle, bool in_view) {
    if (pairs_.contains(track) || !taken.insert(obstacle).second) return;
    pairs_.emplace(track, PairedObstacle{obstacle, in_view});
    last_obstacle_[track] = obstacle;
  };
  std::vector<Near> pairs;
  std::vector<const Track*> out_of_view;
  const bool in_parts = !record_.sightings.empty();
  for (const Track& track : set.tracks) {
    const bool in_view = track.kind != TrackKind::Estimated || is_in_view(track, set.made_at);
    if (record_.truth.contains(track.id)) {
      give(track.id, track.id, in_view);
    } else if (!in_view) {
      out_of_view.push_back(&track);
    } else {
      const UTime at = std::max(track.motion.start, set.made_at);
      const Vec3 p = motion_at(curves_of(track.motion), at).p;
      const std::size_t others = pairs.size();
      for (const auto& [obstacle, history] : record_.truth) {
        const ObstacleHistory::Sample* truth = sample_at(history, at);
        if (truth == nullptr) continue;
        const Vec3 away = (p - truth->p).cwiseAbs();
        const Vec3 extents = truth->half_extents + (in_parts ? track.half_extents : Vec3::Zero());
        const double to_box = (away - extents).cwiseMax(0.0).norm();
        if (to_box >= kPairingRange) continue;
        const Box own = box_around(p, track.half_extents), whole = box_around(truth->p, truth->half_extents);
        pairs.push_back({to_box, in_parts ? share_outside(whole, own) : 0.0, away.norm(), track.id, obstacle});
      }
      if (in_parts && pairs.size() > others) {
        pairs[others] = *std::min_element(pairs.begin() + static_cast<std::ptrdiff_t>(others), pairs.end(), is_nearer);
        pairs.resize(others + 1);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), is_nearer);
  for (const Near& near : pairs) give(near.track, near.obstacle, true);
  for (const Track* track : out_of_view) {
    if (const auto had = last_obstacle_.find(track->id); had != last_obstacle_.end())
      give(track->id, had->second, false);
  }
  return pairs_;
}

}  // namespace tern::audit
