// The referee's measures other than clearance, recomputed with proven bounds.
#pragma once

#include <string>
#include <vector>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A value between two bounds.
struct Between {
  double low = 0.0, high = 0.0, best = 0.0;  ///< best: computed along the recorded curve
};

/// How often a region's border may have been crossed.
struct Border {
  int crossings = 0;  ///< time spans in which a crossing is possible
  bool open = false;  ///< the latest step belongs to such a span
};

/// Time and length in one region.
struct RegionMeasure {
  std::string region;
  Between seconds, metres;            ///< inside
  Between near_seconds, near_metres;  ///< within 1 m of it, inside included
  Border border, near_border;
};

/// The measures of the whole flight.
struct Measures {
  Between path_m;
  Between top_speed;  ///< m/s; low: the least that a referee with steps of kRefereeLook must have seen
  std::vector<RegionMeasure> regions;
  double unseen_s = 0.0;  ///< part of the flight before the first and after the last recorded state
};

/// Longest time between two speeds that the referee reads, s.
inline constexpr double kRefereeLook = 0.005;

/// Measures the whole flight. Where states are missing, the bounds are wide.
Measures measure(const FlightRecord& record);

}  // namespace tern::audit
