// Inspects a scenario without flying it: its contents, whether the goal can be reached, and the effect of λ.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "campaign/flight_inputs.h"
#include "core/scenario/scenario.h"
#include "semantic_mapper/app/cloud_report.h"
#include "simulator/worlds/world.h"

namespace tern {

/// A path from start to goal around static obstacles.
struct PlannedPath {
  std::vector<Vec3> points;  ///< W, m
  double length_m = 0.0;
  std::vector<double> in_region_m;  ///< length inside each region of the scenario
};

/// A scenario with its world, map and paths.
struct ScenarioView {
  Scenario scenario;
  World world;
  std::vector<Box> occupied;            ///< of the map, W
  std::string map;                      ///< extents as text
  std::vector<MapRemark> clouds;        ///< on the map's point clouds
  std::vector<std::string> warnings;    ///< on recorded tracks, and on limits that the vehicle cannot give
  std::optional<PlannedPath> shortest;  ///< nullopt: the goal cannot be reached
  std::string blocked;                  ///< if the goal cannot be reached: the obstruction, as text
  std::optional<PlannedPath> weighted;  ///< with the regions' λ; nullopt: unreachable, or λ has no effect
};

/// Reads the scenario and every process's section as a flight would, and makes world, map and paths. Paths are the
/// planner's own, around static obstacles and occupied voxels, for this body with executor.tube_m, and this flight box.
/// Moving obstacles are ignored. A goal also counts as unreachable if the sensor is too late for the planner
/// (late_sensor()).
/// @throws ConfigError for inputs that a flight would refuse
ScenarioView view_scenario(const FlightInputs& inputs, std::optional<std::uint64_t> seed);

/// Returns about a screenful of text.
std::string to_text(const ScenarioView& view);

/// Returns the numbers of obstacles at world time 0, and of later ones, as text.
std::string world_text(const World& world);
/// Returns the label of the region's class: "attractive". @pre the scenario has that class
const std::string& region_label(const Scenario& scenario, const Region& region);
/// Returns "z 0 to 4 m".
std::string region_heights(const Region& region);

}  // namespace tern
