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
  NotFollowing,   ///< a pilot took over, or the autopilot did not fly the setpoints
  EstimateLost,   ///< the estimator has no position
  StateRefused,   ///< UAV_STATE or VEHICLE_STATUS were refused or too old
  StaleWorld,     ///< predictions were missing or too old
  GoalBlocked,    ///< the map, static obstacles or the flight box leave no way
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

/// Explains a flight's end. Of a timeout it looks at the time since the vehicle stood, or came nearer to the goal last.
/// The first of these that held then is the cause:
///
///  1. no request at all             5. the vehicle is on its way: the time was too short
///  2. a silent process              6. the most frequent kind of answers
///  3. the vehicle did not follow    7. no progress although plans were given
///  4. its state was unusable
Explanation explain(const FlightEvidence& evidence, const FlightEnd& end);

}  // namespace tern
