// The paper's section 6.1: semantic A* alone against one moving obstacle, with what separates its six segments from it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/plane.h"
#include "core/world/scenario.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"

namespace tern {

struct SearchCase {
  std::string name, title;
  std::string scenario;                ///< file's name without its ending
  std::vector<std::string> overrides;  ///< key=value
};
/// None, attractive (λ_att = 2) and repulsive (λ_rep = 0.5).
const std::vector<SearchCase>& search_cases();

/// One interval of the plan beside the obstacle.
struct SearchSegment {
  Points curve_hull;     ///< 3×4, MINVO points, m
  Points obstacle_hull;  ///< 3×n, C_ij without the radius, m
  Plane plane;           ///< of widest margin between the two
  double gap_m = 0.0;    ///< that it leaves, vehicle's radius included; 0: none separates the whole interval
};

struct SearchOutcome {
  bool found = false;
  Scenario scenario;
  Track obstacle;
  TimedSpline trajectory;
  std::vector<SearchSegment> segments;
  double path_length_m = 0.0;
  double mean_distance_m = 0.0;         ///< to the region's centre, over the path; without a region 0
  double inside_m = 0.0, near_m = 0.0;  ///< metres in the region, and within 1 m of it (inside included)
  std::int64_t expansions = 0;
};

/// plan() with its optimizer off and a path that knows no regions, from rest at the start, without a clock: the search
/// alone, deterministic.
/// @param more  key=value, over the case's own. @throws ConfigError for a scenario that is not there or invalid.
SearchOutcome run_search_case(const SearchCase& wanted, const std::vector<std::string>& more = {});

std::string search_columns();
std::string to_csv(const SearchCase& which, const SearchOutcome& outcome);

}  // namespace tern
