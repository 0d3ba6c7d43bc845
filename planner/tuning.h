// The planner's tuning numbers: chosen by experiment, not derived, and no knobs. Tolerances stand where they are
// defined.
#pragma once

#include <cstddef>

#include "core/base/types.h"

namespace tern {

// The local goal and the way to it.

/// The sphere's border is left to rounding and to MINVO points that bulge: local goals lie this far inside, as a share
/// of r.
inline constexpr double kLocalGoalShare = 0.985;
/// A path that is longer than the straight line, or cheaper, by no more than this counts as straight, m.
inline constexpr double kBendIgnored = 0.15;
/// At rest on the way to a goal and without a plan: how many smaller steps are tried, and by what they shrink.
inline constexpr int kSmallerSteps = 3;
inline constexpr double kSmallerStep = 3.0;

// What a trajectory is worth.

/// For how long a trajectory is taken to be flown before a better one follows, s; where a step takes minutes, this
/// share of it: nothing better follows within a second.
struct While {
  double least_s;
  double share;
};
inline constexpr While kWhiles[] = {{0.3, 0.15}, {0.8, 0.4}};
/// An optimized trajectory may arrive so much later than the search's, and one that sets out than waiting, s.
inline constexpr double kSmoothnessPrice = 0.05;
/// Where Δt is shorter than this, s, arrivals say little …
inline constexpr Duration kMoment{40'000};
/// … and an optimized trajectory keeps this share of the leaf's progress at least.
inline constexpr double kProgressKept = 0.5;
/// A plan that sets out ends nearer to the local goal by this, m.
inline constexpr double kNearer = 1e-6;
/// No longer duration is tried once an end that holds lies this near the local goal, m.
inline constexpr double kNearLocalGoal = 1.0;

}  // namespace tern
