// How motions are declared whose own pieces are too many for a message: coarser, with their error in α.
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
///   Duration: an oscillation, as Hermite pieces of this length;
///   Track: waypoints, resampled; one round if they repeat. Its times are world time, UTime{0} being world time 0;
///   Box: what moves too fast to be followed: the box of all places where its centre ever is, W.
using CoarseMotion = std::variant<Duration, Track, Box>;

/// By the obstacle's id; who is not in it is declared by its own pieces.
using CoarseMotions = std::map<std::int64_t, CoarseMotion>;

/// The motions of the world that need more than `pieces` pieces for a span of `window`, on average over their way, made
/// coarser to fit. Oscillations: pieces of the least multiple of 10 ms with window/h + 1 ≤ pieces. Waypoints: resampled
/// (core/world/resampling.h) once for the whole way, to pieces · max(1, its length/window). So successive sets agree,
/// and long rests leave their pieces to turns. Where the error would exceed the box of all places, or a repeating way
/// is shorter than its pieces, it is that box.
///
/// Pure. O(n log n) of the waypoints. @param pieces ≥ 1.
CoarseMotions coarse_motions(const World& world, Duration window, std::size_t pieces);

/// How many obstacles can be in one declaration at most.
struct PresentCount {
  std::size_t moving = 0, resting = 0;
};

/// Counts those that vanish while they are present and for `after` more. O(n log n).
PresentCount max_present(const World& world, Duration after);

}  // namespace tern
