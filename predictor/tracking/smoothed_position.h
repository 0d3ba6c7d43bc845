// Where a track was: its position at an earlier time, smoothed from the detections around it.
#pragma once

#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern {

/// The smoothed position at a time is a parabola through the detections within kSmoothingSpan of it, s. It needs four
/// detections, at three instants, and some on both sides. Otherwise it is the straight line between two neighbours that
/// are at most kMaxGap apart, s.
inline constexpr double kSmoothingSpan = 0.2, kMaxGap = 0.5;

/// A position of a track with its variance, as detected or smoothed.
struct Measurement {
  UTime at;
  Vec3 z, r;  ///< W, m; m²
};

/// Returns the smoothed position at `at`, or nullopt if no detections are near enough. O(detections).
/// @param detections  ascending in time
std::optional<Measurement> smoothed_position(const std::vector<Measurement>& detections, UTime at);

/// Returns the detection nearest in time. @pre there is one
const Measurement& nearest_in_time(const std::vector<Measurement>& detections, UTime at);

}  // namespace tern
