// The message TRACK_BOUNDS: the reason for the width of predicted boxes, for display.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

inline constexpr int kMaxTrackBounds = 800;  ///< in a TrackBounds

/// The kind of model that predicts a track, or the age of a track that is too young for one.
enum class MotionKind : std::uint8_t {
  New,      ///< detected once
  Young,    ///< detected for less than kYoungAge (predictor/tracking)
  Steady,   ///< predicted best by steady models
  Calm,     ///< predicted best by calm models
  Lively,   ///< predicted best by lively models
  Learnt,   ///< predicted best by the model that is learnt in flight
  Resting,  ///< stationary
};
inline constexpr std::size_t kMotionKinds = 7;

/// The source of a track's α.
enum class BoundRule : std::uint8_t {
  Model,     ///< the variance of the models
  Prior,     ///< prediction errors of such tracks in recordings; they weigh more than those of this flight
  Measured,  ///< prediction errors of such tracks in this flight
  Reach,     ///< the largest distance that an obstacle can have moved
};
inline constexpr std::size_t kBoundRules = 4;

/// The bounds of one estimated track at one time ahead: half-widths, m, on the axis where they are largest. For a
/// stationary track, `model` is the filter's position bound, and `measured` comes from tracks that started to move.
struct TrackBound {
  std::int64_t id = 0;
  MotionKind kind = MotionKind::New;
  BoundRule ruled_by = BoundRule::Model;
  double ahead_s = 0.0;   ///< time after TrackBounds::at, s
  double model = 0.0;     ///< bound by the models' variance: z σ, where P[|error| > z σ] = 1 − confidence
  double measured = 0.0;  ///< bound by past prediction errors
  double promised = 0.0;  ///< α at that time
  double evidence = 0.0;  ///< effective number of independent prediction errors in this flight
};

/// TRACK_BOUNDS: the bounds of the estimated tracks of one prediction set.
struct TrackBounds {
  Header header;
  UTime at;                   ///< start of the predictions
  double confidence = 1.0;    ///< (0, 1]
  std::int32_t left_out = 0;  ///< tracks that did not fit into the message
  std::vector<TrackBound> bounds;
};

}  // namespace tern
