#include "predictor/tracking/new_tracks.h"

#include <algorithm>

namespace tern {

NewTracks new_tracks(const std::vector<TrackedObject>& tracks, const ObservationSet& from, const Matching& matching) {
  NewTracks result;
  for (std::size_t d = 0; d < from.detections.size(); ++d) {
    if (matching.taken[d]) continue;
    const std::int64_t given = from.detections[d].track_id;
    const bool known =
        given != kNoTrackId && std::ranges::any_of(tracks, [&](const TrackedObject& o) { return o.id == given; });
    if (!known) result.detections.push_back(d);
  }
  const auto tentative = std::ranges::count_if(tracks, [](const TrackedObject& o) { return !o.confirmed; });
  const std::size_t room = kMaxTentative - std::min(kMaxTentative, static_cast<std::size_t>(tentative));
  if (result.detections.size() <= room) return result;
  result.left_out = result.detections.size() - room;
  std::ranges::stable_sort(result.detections, {}, [&](std::size_t d) {
    return (from.detections[d].position - from.sensor_position).squaredNorm();
  });
  result.detections.resize(room);
  std::ranges::sort(result.detections);
  return result;
}

}  // namespace tern
