// The message FLIGHT_RESULT: the referee's verdict.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/wire/header.h"

namespace tern {

/// How a flight ended. Failed: the flight could not be flown to an end.
enum class FlightOutcome : std::uint8_t { Reached = 0, Collision = 1, Timeout = 2, Failed = 3 };

/// Time and path length of a flight inside one region, and within 1 m of it.
struct Exposure {
  std::string region;
  double seconds = 0.0, metres = 0.0;
  double near_seconds = 0.0, near_metres = 0.0;
};

/// The verdict and its measures. A measure without a value is NaN; `first_entry_s` for example, if the vehicle never
/// came within 0.2 m of the goal.
struct FlightResult {
  Header header;
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;          ///< in words: the obstacle that was hit, the limit that was broken, the failure
  double flight_time_s = 0.0;  ///< world time at arrival, else at the end
  double first_entry_s = 0.0;  ///< world time of the first entry into the 0.2 m ball about the goal
  double path_length_m = 0.0;
  double mean_speed_mps = 0.0;  ///< straight distance from start to goal / flight time; NaN if the goal changed
  double top_speed_mps = 0.0;
  double min_clearance_m = 0.0;         ///< from obstacles, in continuous time; negative if the bodies overlap
  double min_map_clearance_m = 0.0;     ///< the same from the map's occupied voxels
  double jerk_integral = 0.0;           ///< ∫‖jerk‖² dt, m²/s⁵
  std::int64_t stops = 0;               ///< times the vehicle came to rest before the goal
  std::int64_t limit_violations = 0;    ///< times a limit was broken, a jump included
  std::int64_t contacts_moving = 0;     ///< contacts while the vehicle was faster than 0.1 m/s
  std::int64_t contacts_at_rest = 0;    ///< contacts while it was slower
  std::int64_t obstacles = 0;           ///< obstacles that existed at some time of the flight
  std::int64_t obstacles_left_out = 0;  ///< recorded obstacles left out because they appeared too near to the vehicle
  std::vector<Exposure> exposure;
};

}  // namespace tern
