// The classes of tracks, and the times ahead up to which their predictions are scored and judged. The predictor,
// tern-calibrate, tern-audit and tern-campaign share them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/world/names.h"
#include "core/world/track_bounds.h"

namespace tern {

/// The age of a track.
enum class TrackAge : std::uint8_t {
  New,    ///< detected once
  Young,  ///< younger than kYoungAge: its speed is still unknown
  Grown,  ///< younger than kGrownAge
  Old,    ///< kGrownAge or older
};
inline constexpr std::size_t kTrackAges = 4;
inline constexpr double kYoungAge = 0.3, kGrownAge = 1.0;  ///< s
template <>
inline constexpr std::array<const char*, kTrackAges> kWords<TrackAge>{"new", "young", "grown", "old"};

/// Returns the age of a track by its detections. @param age_s  time from the first to the last one, s
constexpr TrackAge track_age(int detections, double age_s) {
  if (detections <= 1) return TrackAge::New;
  if (age_s < kYoungAge) return TrackAge::Young;
  return age_s < kGrownAge ? TrackAge::Grown : TrackAge::Old;
}

/// A receiver of PREDICTIONS cannot count detections. To it a track is new for this long, s: in three sets at 20 Hz.
inline constexpr double kNewInPredictions = 0.1;
/// Returns the age of a track that has been in PREDICTIONS for `age_s`. It is known for a little longer than a receiver
/// can see, but a bound still belongs to the lesser age.
constexpr TrackAge age_in_predictions(double age_s) {
  if (age_s <= kNewInPredictions) return TrackAge::New;
  if (age_s <= kYoungAge) return TrackAge::Young;
  return age_s <= kGrownAge ? TrackAge::Grown : TrackAge::Old;
}

/// The class of a track: its age, and the kind of models that predict it best. The motion of a new or young track says
/// little about its kind: `motion` is New or Young then, and only then.
struct TrackClass {
  TrackAge age = TrackAge::New;
  MotionKind motion = MotionKind::New;
  friend constexpr bool operator==(const TrackClass&, const TrackClass&) = default;
};
inline constexpr TrackClass kNewTrack{}, kYoungTrack{TrackAge::Young, MotionKind::Young};

/// A prediction interval is scored, calibrated and judged up to each of these times ahead, s.
inline constexpr std::array<double, 5> kCoverageHorizons{0.25, 0.5, 1.0, 2.0, 4.5};
inline constexpr std::size_t kHorizons = kCoverageHorizons.size();

}  // namespace tern
