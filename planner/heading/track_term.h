// Tracks whose error bound α costs most: near the plan, and soon.
#pragma once

#include <vector>

#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "planner/heading/look_term.h"

namespace tern {

/// Looks at the estimated tracks that are in the plan's way. A detection makes the α of its track smaller.
///
/// The worth of a track is the largest value over the plan of
///
///     min(ᾱ, kAlphaCap) · exp(−gap / kTrackReach) · exp(−(t − t_s) / kTrackSoon)
///
/// ᾱ is the mean of α over the horizontal axes. The gap is the distance from the plan to the box of track and α. The
/// kTracksSeen tracks of most worth count. The term's unit is m·s: α while it is not looked at.
/// Declared and static tracks are known without looking.
class TrackTerm final : public LookTerm {
 public:
  /// @param tracks  are kept by reference; in ascending order of ids
  /// @param from    t_s
  TrackTerm(const std::vector<Track>& tracks, const TimedSpline& trajectory, UTime from);

  [[nodiscard]] double weight() const override { return 1.0; }
  void look(const LookInstant& now, std::vector<LookTarget>& targets) const override;

 private:
  struct Worth {
    const Track* track;
    double worth;
  };
  std::vector<Worth> seen_;  ///< the tracks of most worth, the largest first
};

}  // namespace tern
