// Coarser declarations, with their error in α, for motions whose own pieces are too many for a message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <variant>

#include "core/base/time.h"
#include "core/world/track.h"
#include "simulator/worlds/world.h"

namespace tern {

/// One of
/// - Duration: an oscillation, as Hermite pieces of this length;
/// - Track: resampled waypoints, one round if they repeat; UTime{0} is world time 0;
/// - Box: for a motion that is too fast to follow, the box of all places of its centre, W.
using CoarseMotion = std::variant<Duration, Track, Box>;

/// By the obstacle's id. Other obstacles are declared by their own pieces.
using CoarseMotions = std::map<std::int64_t, CoarseMotion>;

/// Returns coarser motions for the obstacles that need more than `pieces` pieces per `window`, on average over their
/// path.
///
/// | motion                            | coarser form                                                                 |
/// |-----------------------------------|------------------------------------------------------------------------------|
/// | oscillation                       | pieces of length h, the least multiple of 10 ms with window/h + 1 ≤ pieces   |
/// | waypoints                         | resampled (core/world/resampling.h), to pieces · max(1, its length/window)   |
/// | error larger than the box below   | the box of all places of its centre                                          |
/// | a round shorter than its pieces   | the same box                                                                 |
///
/// Waypoints are resampled once for the whole path, so successive sets agree, and long rests leave their pieces to
/// turns. Pure. O(n log n) for n waypoints. @param pieces  ≥ 1
CoarseMotions coarse_motions(const World& world, Duration window, std::size_t pieces);

/// The largest number of obstacles in one declaration.
struct PresentCount {
  std::size_t moving = 0, resting = 0;
};

/// Counts the obstacles that a declaration may contain at one time. One that vanishes counts while it is present and
/// for `after` more. O(n log n).
PresentCount max_present(const World& world, Duration after);

}  // namespace tern
