// The path of one virtual flight and its world, for drawing.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "simulator/worlds/world.h"

namespace tern {

/// One point of the path.
struct TrackPoint {
  double t_s = 0.0;  ///< since the start of the flight
  Vec3 p = Vec3::Zero();
  double speed_mps = 0.0;
};

/// A flight and its world.
struct FlightTrack {
  Scenario scenario;
  World world;
  std::vector<TrackPoint> points;  ///< every 50 ms
};

/// Flies a scenario file on virtual time. @throws ConfigError for inputs that run_process() would refuse
FlightTrack fly_and_track(const std::string& scenario_file, const std::vector<std::string>& overrides);

}  // namespace tern
