// FLIGHT_RESULT: the referee's verdict.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/world/header.h"

namespace tern {

enum class FlightOutcome : std::uint8_t { Reached = 0, Collision = 1, Timeout = 2, Failed = 3 };

/// Seconds and metres inside one region, and within 1 m of it.
struct Exposure {
  std::string region;
  double seconds = 0.0, metres = 0.0;
  double near_seconds = 0.0, near_metres = 0.0;
};

/// NaN where a measure has no value (a flight that never entered the goal's ball has no first entry).
struct FlightResult {
  Header header;
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;          ///< in words: what was hit, which limit, what failed
  double flight_time_s = 0.0;  ///< world time at arrival or end
  double first_entry_s = 0.0;  ///< first within 0.2 m of the goal
  double path_length_m = 0.0;
  double mean_speed_mps = 0.0;  ///< straight distance / flight time
  double top_speed_mps = 0.0;
  double min_clearance_m = 0.0;      ///< to obstacles, continuous time, negative in overlap
  double min_map_clearance_m = 0.0;  ///< the same to the map's occupied voxels
  double jerk_integral = 0.0;        ///< ∫‖jerk‖² dt, m²/s⁵
  std::int64_t stops = 0;
  std::int64_t limit_violations = 0;
  std::int64_t contacts_moving = 0;     ///< touched something while faster than 0.1 m/s
  std::int64_t contacts_at_rest = 0;    ///< was touched while slower
  std::int64_t obstacles = 0;           ///< that were there at some time of the flight
  std::int64_t obstacles_left_out = 0;  ///< recorded ones that began too near to the vehicle
  std::vector<Exposure> exposure;
};

}  // namespace tern
