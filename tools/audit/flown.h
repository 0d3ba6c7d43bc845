// What really happened in continuous time: the vehicle's and the obstacles' motion between their recorded samples.
#pragma once

#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A motion between two samples.
///
/// The curve is the cubic through both samples' positions and velocities. Where each component of velocity is monotone
/// between them, the true motion is a mixture of motions with one jump of velocity, and one of Δv at the share s of the
/// span h leaves the cubic by 2 s²(1 − s)² h |Δv| at most: hence error = h |Δv| / 8, with the largest Δv of this and
/// the neighbouring spans, so that an extremum of velocity within one span is covered by its neighbours.
struct Sampled {
  Curve curve;
  double error_m = 0.0;
};

/// States farther apart than this leave a hole.
inline constexpr Duration kStateHole{50'000};
/// Samples of a moving obstacle farther apart than this leave a hole (it may have vanished in between).
inline constexpr Duration kTruthHole{200'000};

struct SampledMotion {
  std::vector<Sampled> spans;  ///< in order; holes are left out
  Duration holes;              ///< how long they are together
  std::int64_t hole_count = 0;
};

SampledMotion flown(const FlightRecord& record);
SampledMotion moved(const ObstacleHistory& history);

/// The time that the referee judged, or all that was recorded: from the first request (the first state) to the verdict
/// (the last state). After it the vehicle asks for no more plans, and answers for nothing.
struct Window {
  UTime from, to;
};
Window judged(const FlightRecord& record);

}  // namespace tern::audit
