// The world of a flight: all true obstacles, a pure function of the scenario and its recorded files.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/scenario.h"
#include "core/world/observation.h"
#include "simulator/worlds/obstacle.h"

namespace tern {

struct World {
  std::vector<WorldObstacle> obstacles;  ///< the generator's, then the listed, then the recorded; obstacles[k].id() = k
  int redrawn = 0;   ///< draws of generator and copies that were repeated: too near to start or goal
  int left_out = 0;  ///< recorded people that are left out: too near to the start at a drawn time
  std::vector<double> recorded_start_s;  ///< per recorded file without copies: its time at world time 0, s
  std::vector<std::string> remarks;      ///< on the recorded files (RecordedFile)
};

/// Makes the world of scenario.world with scenario.seed. Start and goal of scenario.uav affect the redraws
/// (generators.h) and the choices from recordings (drawn_recordings.h). If the beginning is drawn, tracks too near to
/// the start are left out.
/// @param data_dir  second folder for recorded files, after that of the scenario
/// @return an Error for the author of the scenario.
Result<World> make_world(const Scenario& scenario, const std::string& data_dir);

/// Returns the scenario with all obstacles of its world in the list, without generator and recordings. make_world makes
/// the same obstacles of it, with the same bits and ids.
Scenario list_obstacles(const Scenario& scenario, const World& world);

/// Returns the obstacles present at world time t_s, by id ascending: the content of OBSTACLE_TRUTH. At t_s < 0 they
/// move towards their places at 0. An obstacle whose motion begins between t_s and 0 is absent.
std::vector<TrueObstacle> true_obstacles(const World& world, double t_s);

/// Returns the boxes of all static obstacles, W, by id ascending.
std::vector<Box> static_boxes(const World& world);

}  // namespace tern
