// Why a flight did not reach its goal, in one sentence.
#pragma once

#include <optional>
#include <string>

#include "core/world/flight_result.h"
#include "monitor/flight_evidence.h"

namespace tern {

/// The reason that held the vehicle, or ended its flight.
enum class Cause : std::uint8_t {
  None,           ///< it reached its goal
  NeverBegan,     ///< no plan was requested
  Failure,        ///< a process could not run, or a limit was broken: the flight's end says it
  Contact,        ///< it touched an obstacle or the map
  ProcessSilent,  ///< the HEARTBEAT of a process ceased
  NotFollowing,   ///< a pilot took over, or the vehicle did not fly the setpoints
  EstimateLost,   ///< the estimator has no position
  StateRefused,   ///< UAV_STATE or VEHICLE_STATUS were refused or too old
  StaleWorld,     ///< predictions were missing or too old
  GoalBlocked,    ///< map, static obstacles or flight box leave no way, or an obstacle is at the goal
  NoPlan,         ///< no certified trajectory was found
  TooSlow,        ///< answers came too late, or their time was too short
  EstimateOff,    ///< it rests at its goal by its own estimate only
  NoProgress,     ///< it moved, or was given plans, and came no nearer
  TimeTooShort,   ///< it was on its way
};
inline constexpr int kCauses = 15;
/// Returns the word: "stale world".
const char* to_string(Cause cause);

/// A flight's end, to be explained.
struct FlightEnd {
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;
  std::optional<FlightResult> result = {};  ///< the referee's, if it published one
  /// Seconds of flight per second of the system's clock; nullopt: virtual time, or a clock that cannot be slowed.
  std::optional<double> pace = {};
};

/// A cause, and a sentence for a person who has nothing else: what held the vehicle, since when, the evidence, and what
/// would help. Times count from the first request. Both are empty if the goal was reached.
struct Explanation {
  Cause cause = Cause::None;
  std::string sentence;
};

/// Explains a flight's end. For a timeout, the time since the vehicle came to stand is judged, or else the time since
/// it last came nearer to its goal. The cause is the first of these that is true:
///
/// 1. There was no request.
/// 2. A process is silent.
/// 3. The vehicle did not follow.
/// 4. tern-executor waits: its state was unusable, a live map is old, or it has given the vehicle up.
/// 5. The vehicle is on its way: the time was too short.
/// 6. Most answers gave one reason.
/// 7. There were plans, but no progress.
Explanation explain(const FlightEvidence& evidence, const FlightEnd& end);

}  // namespace tern
