#include "predictor/models/declared.h"

#include <algorithm>
#include <cstddef>
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
  kept.alpha.assign(track.alpha.begin() + from, track.alpha.begin() + to);
  return kept;
}

}  // namespace

std::vector<Track> trimmed(const std::vector<Track>& declared, UTime now, Duration horizon) {
  std::vector<Track> kept;
  kept.reserve(declared.size());
  for (const Track& track : declared) kept.push_back(trimmed_track(track, now, now + horizon));
  return kept;
}

bool is_explained(const Detection& detection, UTime at, const std::vector<Track>& declared) {
  const Vec3 noise = kExplainedSigmas * detection.variance.cwiseSqrt();
  return std::any_of(declared.begin(), declared.end(), [&](const Track& track) {
    if (detection.track_id != kNoTrackId && detection.track_id == track.id) return true;
    return grown(track.bounds(at, at), noise).contains(detection.position);
  });
}

ObservationSet without_explained(ObservationSet observations, const std::vector<Track>& declared) {
  std::erase_if(observations.detections,
                [&](const Detection& detection) { return is_explained(detection, observations.at, declared); });
  return observations;
}

std::vector<Track> merged(std::vector<Track> declared, const std::vector<Track>& estimated, UTime now) {
  std::vector<Track> all = std::move(declared);
  const std::size_t declared_count = all.size();
  for (const Track& track : estimated) {
    const Vec3 centre = track.motion.sample(now).p;
    const bool explained = std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(declared_count),
                                       [&](const Track& owner) {
                                         return owner.id == track.id || owner.bounds(now, now).contains(centre);
                                       });
    if (!explained) all.push_back(track);
  }
  std::sort(all.begin(), all.end(), [](const Track& a, const Track& b) { return a.id < b.id; });
  return all;
}

}  // namespace tern
