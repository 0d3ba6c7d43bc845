#include "tools/audit/pairing.h"

#include <set>
#include <tuple>
#include <vector>

#include "tools/audit/cubic.h"

namespace tern::audit {
namespace {

struct Near {
  double to_box, to_centre;
  std::int64_t track, obstacle;
};

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
  const auto& all = record_.observations;
  if (all.empty()) return true;
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
  for (const Track& track : set.tracks) {
    const bool in_view = track.kind != TrackKind::Estimated || is_in_view(track, set.made_at);
    if (record_.truth.contains(track.id)) {
      give(track.id, track.id, in_view);
    } else if (!in_view) {
      out_of_view.push_back(&track);
    } else {
      const UTime at = std::max(track.motion.start, set.made_at);
      const Vec3 p = motion_at(curves_of(track.motion), at).p;
      for (const auto& [obstacle, history] : record_.truth) {
        const ObstacleHistory::Sample* truth = sample_at(history, at);
        if (truth == nullptr) continue;
        const Vec3 away = (p - truth->p).cwiseAbs();
        const double to_box = (away - truth->half_extents).cwiseMax(0.0).norm();
        if (to_box < kPairingRange) pairs.push_back({to_box, away.norm(), track.id, obstacle});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Near& a, const Near& b) {
    return std::tie(a.to_box, a.to_centre, a.track, a.obstacle) < std::tie(b.to_box, b.to_centre, b.track, b.obstacle);
  });
  for (const Near& near : pairs) give(near.track, near.obstacle, true);
  for (const Track* track : out_of_view) {
    if (const auto had = last_obstacle_.find(track->id); had != last_obstacle_.end())
      give(track->id, had->second, false);
  }
  return pairs_;
}

}  // namespace tern::audit
