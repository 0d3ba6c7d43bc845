// TRACK_BOUNDS: why predicted boxes are as wide as they are, for people.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/world/header.h"

namespace tern {

inline constexpr int kMaxTrackBounds = 800;  ///< in a TrackBounds

/// By what a track is predicted.
enum class MotionKind : std::uint8_t {
  New,      ///< seen once
  Young,    ///< seen for less than kYoungAge (calibration.h)
  Steady,   ///< best by steady models (model_bank.h)
  Calm,     ///< by calm ones
  Lively,   ///< by lively ones
  Learnt,   ///< by the one that is learnt in the flight (learnt_model.h)
  Resting,  ///< at rest
};
inline constexpr std::size_t kMotionKinds = 7;

/// What the width of a promise follows from.
enum class BoundRule : std::uint8_t {
  Model,     ///< what the models say themselves
  Prior,     ///< errors that such tracks made in recordings: they count more than this flight's own
  Measured,  ///< errors that such tracks made in this flight
  Reach,     ///< how far anything can have moved
};
inline constexpr std::size_t kBoundRules = 4;

/// Of one estimated track, so far ahead. Half-widths, m, of the axis on which they are largest. Of what rests the
/// models say what its filter holds at all times, and past errors are starts.
struct TrackBound {
  std::int64_t id = 0;
  MotionKind kind = MotionKind::New;
  BoundRule ruled_by = BoundRule::Model;
  double ahead_s = 0.0;   ///< after TrackBounds::at
  double model = 0.0;     ///< what the models say themselves: z σ, P[|error| > z σ] = 1 − confidence
  double measured = 0.0;  ///< what past errors ask for
  double promised = 0.0;  ///< α at that time
  double evidence = 0.0;  ///< for how many independent errors this flight's own count, in the band of that time
};

struct TrackBounds {
  Header header;
  UTime at;                   ///< when the predictions began
  double confidence = 1.0;    ///< (0, 1]
  std::int32_t left_out = 0;  ///< tracks that did not fit
  std::vector<TrackBound> bounds;
};

}  // namespace tern
