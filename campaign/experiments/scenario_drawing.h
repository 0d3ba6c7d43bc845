// Draws a scenario from above and from the side.
#pragma once

#include <string>
#include <utility>

#include "campaign/experiments/scenario_view.h"

namespace tern {

/// Movers' ways are drawn for this long from world time 0 on, s.
inline constexpr double kWaySeconds = 10.0;

/// Returns an SVG with two views, a key below them.
///
/// - From above: map and static obstacles at the vehicle's height, moving obstacles at world time 0 with their ways,
///   regions, names.
/// - From the side, along x or y: the voxels, obstacles and regions that the path passes over, under or through.
///
/// The vehicle's height is the one at which it flies half of the shortest path, or between start and goal without a
/// path. The first view therefore shows the walls of a scanned room, without its floor and its ceiling.
std::string draw_scenario(const ScenarioView& view);

/// Returns the heights at which the first view shows map and static obstacles, W, m: those of the body.
std::pair<double, double> drawn_heights(const ScenarioView& view);

}  // namespace tern
