// Which detections start tracks.
#pragma once

#include <cstddef>
#include <vector>

#include "core/world/observation.h"
#include "predictor/tracking/matching.h"
#include "predictor/tracking/tracked_object.h"

namespace tern {

/// At most this many tracks are tentative at once. Sensors with many false detections would otherwise take the time of
/// the confirmed tracks: 512 cost some 7 ms per set.
inline constexpr std::size_t kMaxTentative = 512;

struct NewTracks {
  std::vector<std::size_t> detections;  ///< indices, ascending
  std::size_t left_out = 0;             ///< detections that found no room
};

/// Returns the detections that start tracks: unmatched ones whose id, if given, is new. If kMaxTentative
/// leaves no room for all, the nearest to the sensor start. O(d·t) for detections with ids, else O(d log d).
NewTracks new_tracks(const std::vector<TrackedObject>& tracks, const ObservationSet& from, const Matching& matching);

}  // namespace tern
