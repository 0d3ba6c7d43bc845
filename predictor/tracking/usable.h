// Removes what is too uncertain to use, and ids that are not allowed.
#pragma once

#include <cstddef>

#include "core/world/observation.h"
#include "core/world/sighting.h"
#include "predictor/tracking/tracker.h"

namespace tern {

/// The largest usable standard deviation on an axis, m: at 4 σ the box is wider than all that a vehicle crosses within
/// a horizon. Messages may hold up to 1e6 m. That would make α larger than PREDICTIONS can hold, and leave a covariance
/// of rounding errors after the next good detection (1e12 m² − 1e12 m²).
inline constexpr double kMaxDeviation = 30.0;

/// Removes the detections with a larger deviation. @return their number
inline std::size_t remove_unusable(ObservationSet& set) {
  return std::erase_if(set.detections,
                       [](const Detection& d) { return !(d.variance.maxCoeff() <= kMaxDeviation * kMaxDeviation); });
}

/// The same for sightings, by their measured bounds.
inline std::size_t remove_unusable(SightingSet& set) {
  return std::erase_if(set.sightings, [](const Sighting& s) {
    return !(s.lower_sigma.maxCoeff() <= kMaxDeviation && s.upper_sigma.maxCoeff() <= kMaxDeviation);
  });
}

/// Removes ids that only the predictor's own tracks may have (kFirstOwnTrackId): these detections are matched by their
/// place. @return their number
inline std::size_t remove_foreign_ids(ObservationSet& set) {
  std::size_t removed = 0;
  for (Detection& detection : set.detections) {
    if (detection.track_id < kFirstOwnTrackId) continue;
    detection.track_id = kNoTrackId;
    ++removed;
  }
  return removed;
}

}  // namespace tern
