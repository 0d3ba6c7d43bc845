// Which true obstacle a track belongs to, and the error bound α that would have covered it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>

#include "tools/audit/check.h"
#include "tools/audit/flight_record.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {

/// A track in view may be paired with an obstacle whose box is at most this far from the track's centre, m.
inline constexpr double kPairingRange = 2.0;
/// The truth is unknown in a longer gap between samples.
inline constexpr Duration kUnknownFor = kTruthHole;
/// A track is in view for this long after a detection whose box overlaps its own.
inline constexpr Duration kInViewFor{300'000};

/// A track that is missing from the sets for longer counts as new when it reappears.
inline constexpr Duration kForgottenAfter{500'000};
/// Tolerance for rounding: a true box may stand out of a prediction interval by this much, m.
inline constexpr double kOutTolerance = 1e-6;

/// Returns true if the plan claims a confidence: a level of α at full scale, for some time.
inline bool claims_confidence(const Plan& plan) {
  return plan.outcome != PlanOutcome::NoPlan && plan.confidence > 0.0 && !plan.relaxed;
}

/// The obstacle of a track, and whether a sensor saw it within kInViewFor.
struct PairedObstacle {
  std::int64_t obstacle = kNoObstacle;
  bool in_view = true;
};

/// Pairs the tracks of each set with true obstacles. An obstacle has at most one track.
class Pairing {
 public:
  explicit Pairing(const FlightRecord& record) : record_(record) {}

  /// Pairs one set; call it in the order in which the sets were made.
  ///
  /// 1. A track whose id is that of a true obstacle is paired with it.
  /// 2. Other tracks in view get the remaining obstacles within kPairingRange, nearest pairs first. The order is by
  ///    distance from the track's centre to the true box, then to the box's centre.
  /// 3. A track out of view keeps its earlier obstacle unless another track has it: its prediction still applies.
  ///
  /// In a log without observations and sightings every track is in view.
  ///
  /// Several tracks may belong to one obstacle that is seen in parts. In a log with sightings, rule 2 therefore offers
  /// a track one obstacle alone. It is the one whose box is nearest to the track's, then the one of which the least
  /// share lies outside the track's box.
  /// @return by track id; unpaired tracks are not in it
  const std::map<std::int64_t, PairedObstacle>& pair(const TrackSet& set);

 private:
  [[nodiscard]] bool is_in_view(const Track& track, UTime made_at) const;
  [[nodiscard]] static bool is_seen_in(const std::vector<ObservationSet>& all, const Track& track, UTime made_at);

  const FlightRecord& record_;
  std::map<std::int64_t, PairedObstacle> pairs_;
  std::map<std::int64_t, std::int64_t> last_obstacle_;  ///< track → the obstacle it was last paired with
};

/// The α that one truth sample requires of a track's piece.
struct RequiredAlpha {
  UTime at;
  std::size_t piece = 0;
  Vec3 alpha;  ///< the least α per axis that covers the true box, m; ≤ 0: covered without any
  Box box;     ///< the true box, W
};

/// Calls visit(RequiredAlpha) for the obstacle's samples in [from, until], up to the first gap of kUnknownFor.
/// @return the time up to which the truth is known, at most `until`; `from` if it is unknown there
template <class Visit>
UTime follow(const Track& track, const ObstacleHistory& truth, UTime from, UTime until, const Visit& visit) {
  auto sample = std::lower_bound(truth.samples.begin(), truth.samples.end(), from,
                                 [](const ObstacleHistory::Sample& s, UTime t) { return s.at < t; });
  UTime followed = from, begin = track.motion.start;
  std::size_t piece = 0;
  for (; sample != truth.samples.end() && sample->at - followed <= kUnknownFor; ++sample) {
    if (sample->at > until) return until;
    const auto& pieces = track.motion.pieces;
    while (piece + 1 < pieces.size() && sample->at > begin + pieces[piece].duration) {
      begin = begin + pieces[piece++].duration;
    }
    const PowerCubic& c = pieces[piece].coefficients;
    const double t = track.kind == TrackKind::Static ? 0.0 : (sample->at - begin).seconds();
    const Vec3 p = ((c.col(0) * t + c.col(1)) * t + c.col(2)) * t + c.col(3);
    visit(RequiredAlpha{sample->at, piece, (sample->p - p).cwiseAbs() + sample->half_extents - track.half_extents,
                        box_around(sample->p, sample->half_extents)});
    followed = sample->at;
  }
  return followed;
}

/// Returns α of a piece at a level of confidence, m.
inline Vec3 alpha_at(const Track& track, std::size_t piece, std::size_t level) {
  return track.alpha_at(piece, static_cast<int>(level));
}

}  // namespace tern::audit
