// Which true obstacle a track speaks of, and how much α its promise needed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>

#include "tools/audit/check.h"
#include "tools/audit/flight_record.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {

/// A track in view may speak of an obstacle whose box is so near to its centre, m.
inline constexpr double kPairingRange = 2.0;
/// Without a sample for longer the truth is not known.
inline constexpr Duration kUnknownFor = kTruthHole;
/// A track is in view for so long after a detection whose box meets its own.
inline constexpr Duration kInViewFor{300'000};

/// Who was not in the sets for longer is new when it is there again.
inline constexpr Duration kForgottenAfter{500'000};
/// A true box may stand out of a promise by this, m: rounding.
inline constexpr double kOutTolerance = 1e-6;

/// Whether a plan claims a number: a level of confidence, all of its α, for some time.
inline bool claims_confidence(const Plan& plan) {
  return plan.outcome != PlanOutcome::NoPlan && plan.confidence > 0.0 && !plan.relaxed;
}

/// Whom a track speaks of, and whether a sensor saw it just now.
struct PairedObstacle {
  std::int64_t obstacle = kNoObstacle;
  bool in_view = true;
};

/// Pairs the tracks of each set with obstacles, an obstacle with one track at most.
class Pairing {
 public:
  explicit Pairing(const FlightRecord& record) : record_(record) {}

  /// Sets in the order of their making. A track is that obstacle's whose id it has. Of the others those in view get
  /// what is left, the nearest pairs first, up to kPairingRange. Nearness is how far the track's centre is from the
  /// true box, then from its centre. A track out of view keeps the obstacle that it had, while no other track has it:
  /// who has lost sight of something still promises where it is. In a log without observations all tracks are in view.
  /// @return by track; tracks that are not in it are nobody's.
  const std::map<std::int64_t, PairedObstacle>& pair(const TrackSet& set);

 private:
  [[nodiscard]] bool is_in_view(const Track& track, UTime made_at) const;

  const FlightRecord& record_;
  std::map<std::int64_t, PairedObstacle> now_;
  std::map<std::int64_t, std::int64_t> had_;  ///< obstacle by track
};

/// The true box at a sample, against a track's piece.
struct RequiredAlpha {
  UTime at;
  std::size_t piece = 0;
  Vec3 alpha;  ///< the least α per axis that holds the true box, m; negative: the box is inside without any
};

/// Calls visit(RequiredAlpha) for the samples of an obstacle in [from, until], up to its first hole. @return until when
/// it is known, at most `until`; `from` where it is not known at all.
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
    visit(RequiredAlpha{sample->at, piece, (sample->p - p).cwiseAbs() + sample->half_extents - track.half_extents});
    followed = sample->at;
  }
  return followed;
}

/// α of a piece at a level of confidence, m.
inline Vec3 alpha_at(const Track& track, std::size_t piece, std::size_t level) {
  if (level == 0 || track.shares.empty()) return track.alpha[piece];
  return static_cast<double>(track.shares[piece][level - 1]) * track.alpha[piece];
}

}  // namespace tern::audit
