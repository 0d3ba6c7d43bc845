// Which detections a tracker can use.
#pragma once

#include <cstddef>

#include "core/world/observation.h"

namespace tern {

/// A detection whose standard deviation is larger on some axis says nothing of use, m: its box at 4 σ is wider than
/// all that is flown through within a horizon. One of the 1e6 m that a message may hold would make α larger than
/// PREDICTIONS can say, and leave a covariance to rounding once a good detection follows (1e12 m² − 1e12 m²).
inline constexpr double kMaxDeviation = 30.0;

/// Takes the others out of a set. @return how many
inline std::size_t remove_unusable(ObservationSet& set) {
  return std::erase_if(set.detections,
                       [](const Detection& d) { return !(d.variance.maxCoeff() <= kMaxDeviation * kMaxDeviation); });
}

}  // namespace tern
