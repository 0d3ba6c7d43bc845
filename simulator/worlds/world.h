// The world of a flight: every true obstacle, a pure function of the scenario (and of the recorded files that it
// names).
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/observation.h"
#include "core/world/scenario.h"
#include "simulator/worlds/obstacle.h"

namespace tern {

struct World {
  std::vector<WorldObstacle> obstacles;  ///< the generator's, then the listed, then the recorded; obstacles[k].id() = k
  int redrawn = 0;                       ///< draws of generator and copies that start or goal refused
  int left_out = 0;                      ///< recorded people who leave no room for a drawn beginning
  std::vector<double> recorded_start_s;  ///< per recorded file without copies: its time at world time 0, s
};

/// The world of scenario.world with scenario.seed; start and goal of scenario.uav enter the redraw rule (generators.h)
/// and what is drawn of recordings (drawn_recordings.h). Where the beginning is drawn, who crowds the start is left
/// out.
/// @param data_dir where recorded files are sought besides the scenario's
/// folder.
/// @return an Error for the person who wrote the scenario.
Result<World> make_world(const Scenario& scenario, const std::string& data_dir);

/// The scenario with every obstacle of its world listed: generator none, nothing recorded. From it make_world gives the
/// same obstacles to the last bit, with the same ids.
Scenario list_obstacles(const Scenario& scenario, const World& world);

/// The obstacles present at t_s (world time), by id ascending: what OBSTACLE_TRUTH says. At t_s < 0 they are on their
/// way to where they are at 0. Whose motion begins between then and 0 is not there yet.
std::vector<TrueObstacle> true_obstacles(const World& world, double t_s);

/// The boxes of all obstacles that never move, W, by id ascending.
std::vector<Box> static_boxes(const World& world);

}  // namespace tern
