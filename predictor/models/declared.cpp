#include "predictor/models/declared.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

namespace tern {
namespace {

Track trimmed_track(const Track& track, UTime now, UTime until) {
  if (track.kind == TrackKind::Static || track.motion.pieces.size() < 2) return track;
  const PiecewiseCubic::Located first = track.motion.locate(now);
  std::size_t last = first.index;
  UTime end = first.start + track.motion.pieces[last].duration;
  while (last + 1 < track.motion.pieces.size() && end <= until) end = end + track.motion.pieces[++last].duration;

  const auto from = static_cast<std::ptrdiff_t>(first.index);
  const auto to = static_cast<std::ptrdiff_t>(last + 1);
  Track kept = track;
  kept.motion.start = first.start;
  kept.motion.pieces.assign(track.motion.pieces.begin() + from, track.motion.pieces.begin() + to);
  if (!track.shares.empty()) kept.shares.assign(track.shares.begin() + from, track.shares.begin() + to);
  kept.alpha.assign(track.alpha.begin() + from, track.alpha.begin() + to);
  return kept;
}

// Where a declared track may be at one instant.
struct Region {
  std::int64_t id = 0;
  Box box;
};

bool explains(const Track& track, UTime at) {
  if (track.kind == TrackKind::Static) return true;
  return at + kExplainedSlack >= track.motion.start && at <= track.motion.end() + kExplainedSlack;
}

std::vector<Region> regions_at(const std::vector<Track>& declared, UTime at) {
  std::vector<Region> regions;
  for (const Track& track : declared) {
    if (explains(track, at)) regions.push_back({track.id, track.bounds(at, at)});
  }
  return regions;
}

bool is_explained(const std::vector<Region>& regions, std::int64_t id, const Box& box, const Vec3& by_sigma) {
  const Vec3 margin = by_sigma.cwiseMin(kMaxExplainedMargin);
  return std::any_of(regions.begin(), regions.end(),
                     [&](const Region& region) { return region.id == id || grown(region.box, margin).contains(box); });
}

}  // namespace

std::vector<Track> trimmed(const std::vector<Track>& declared, UTime now, Duration horizon) {
  std::vector<Track> kept;
  kept.reserve(declared.size());
  for (const Track& track : declared) kept.push_back(trimmed_track(track, now, now + horizon));
  return kept;
}

ObservationSet without_explained(ObservationSet observations, const std::vector<Track>& declared) {
  const std::vector<Region> regions = regions_at(declared, observations.at);
  std::erase_if(observations.detections, [&](const Detection& detection) {
    return is_explained(regions, detection.track_id, box_around(detection.position, detection.half_extents),
                        kExplainedSigmas * detection.variance.cwiseSqrt());
  });
  return observations;
}

SightingSet without_explained(SightingSet sightings, const std::vector<Track>& declared) {
  const std::vector<Region> regions = regions_at(declared, sightings.at);
  std::erase_if(sightings.sightings, [&](const Sighting& sighting) {
    const Vec3 margin = kExplainedSigmas / std::numbers::sqrt2 * sighting.lower_sigma.cwiseMax(sighting.upper_sigma);
    return is_explained(regions, kNoTrackId, Box(sighting.lower, sighting.upper), margin);
  });
  return sightings;
}

std::vector<Track> merged(std::vector<Track> declared, const std::vector<Track>& estimated, UTime now) {
  const std::vector<Region> regions = regions_at(declared, now);
  std::vector<Track> all;
  std::set<std::int64_t> replaced;
  for (const Track& track : estimated) {
    if (is_explained(regions, track.id, box_around(track.motion.sample(now).p, track.half_extents), Vec3::Zero()))
      continue;
    all.push_back(track);
    replaced.insert(track.id);
  }
  for (Track& track : declared) {
    if (!replaced.contains(track.id)) all.push_back(std::move(track));
  }
  std::sort(all.begin(), all.end(), [](const Track& a, const Track& b) { return a.id < b.id; });
  return all;
}

}  // namespace tern
