// What the referee measures of a flight besides obstacles, recomputed between proven bounds.
#pragma once

#include <string>
#include <vector>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A number that lies between two bounds.
struct Between {
  double low = 0.0, high = 0.0, best = 0.0;  ///< best: along the recorded curve
};

/// How often a border may have been crossed.
struct Border {
  int crossings = 0;  ///< stretches of time in which it may have been
  bool open = false;  ///< the newest step belongs to one
};

struct RegionMeasure {
  std::string region;
  Between seconds, metres;            ///< inside
  Between near_seconds, near_metres;  ///< within 1 m of it
  Border border, near_border;
};

struct Measures {
  Between path_m;
  Between top_speed;  ///< m/s; low: what a referee that looks every kRefereeLook must have seen
  std::vector<RegionMeasure> regions;
  double unseen_s = 0.0;  ///< of the flight, before the log's first state and after its last
};

/// The referee takes the speed at instants at most this far apart, s.
inline constexpr double kRefereeLook = 0.005;

/// The whole flight, holes included: where no state was recorded the bounds are wide.
Measures measure(const FlightRecord& record);

}  // namespace tern::audit
