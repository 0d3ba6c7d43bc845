// The paper's section 6.1: semantic A* alone against one moving obstacle, and the planes of its six segments.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/plane.h"
#include "core/scenario/scenario.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"

namespace tern {

/// One case of the experiment.
struct SearchCase {
  std::string name, title;
  std::string scenario;                ///< file name without its ending
  std::vector<std::string> overrides;  ///< key=value
};
/// Returns the cases: no region, attractive (λ_att = 2), repulsive (λ_rep = 0.5).
const std::vector<SearchCase>& search_cases();

/// One interval of the plan, and the obstacle over that interval.
struct SearchSegment {
  Points curve_hull;     ///< 3×4, MINVO points, m
  Points obstacle_hull;  ///< 3×n, C_ij without the radius, m
  Plane plane;           ///< of widest margin between the two
  double gap_m = 0.0;    ///< margin of the plane, vehicle's radius included; 0: no plane separates the whole interval
};

/// The result of one case.
struct SearchOutcome {
  bool found = false;
  Scenario scenario;
  Track obstacle;
  TimedSpline trajectory;
  std::vector<SearchSegment> segments;
  double path_length_m = 0.0;
  double mean_distance_m = 0.0;         ///< path average of the distance to the region's centre; 0 without a region
  double inside_m = 0.0, near_m = 0.0;  ///< length inside the region, and within 1 m of it (inside included)
  std::int64_t expansions = 0;
};

/// Runs plan() from rest at the start, with the optimizer off, a path that ignores regions, and no clock. The result is
/// that of the search alone, and deterministic.
/// @param more  key=value, overrides the case's own
/// @throws ConfigError if the scenario is missing or invalid
SearchOutcome run_search_case(const SearchCase& wanted, const std::vector<std::string>& more = {});

std::string search_columns();
std::string to_csv(const SearchCase& which, const SearchOutcome& outcome);

}  // namespace tern
