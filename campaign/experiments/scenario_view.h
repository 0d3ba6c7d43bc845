// A scenario before it is flown: what is in it, whether its goal can be reached, what λ buys; as text and as a plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "campaign/flight_inputs.h"
#include "core/world/scenario.h"
#include "simulator/worlds/world.h"

namespace tern {

/// A way from start to goal around what rests.
struct PlannedPath {
  std::vector<Vec3> points;  ///< W, m
  double length_m = 0.0;
  std::vector<double> in_region_m;  ///< of it, by region of the scenario
};

struct ScenarioView {
  Scenario scenario;
  World world;
  std::vector<Box> occupied;            ///< of the map, W
  std::string map;                      ///< its extents as text
  std::optional<PlannedPath> shortest;  ///< nullopt: the goal cannot be reached
  std::string blocked;                  ///< then: what stands in the way, as text
  std::optional<PlannedPath> weighted;  ///< by the regions' λ; nullopt: not reached, or nothing weighs
};

/// Reads the scenario as a flight would, every process's section too, and makes world, map and ways. The ways are the
/// planner's own around static obstacles and occupied voxels, for this body and flight box. Movers are in no way.
/// @throws ConfigError for what a flight would refuse.
ScenarioView view_scenario(const FlightInputs& inputs, std::optional<std::uint64_t> seed);

/// A screen of text.
std::string to_text(const ScenarioView& view);

/// Seen from above: flight box, regions, occupied voxels, what rests, movers at world time 0, both ways. SVG.
std::string draw_scenario(const ScenarioView& view);

}  // namespace tern
