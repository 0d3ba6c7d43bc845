// One flight as it was flown, with its world: what a map of it is drawn from.
#pragma once

#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "simulator/worlds/world.h"

namespace tern {

struct TrackPoint {
  double t_s = 0.0;  ///< since the flight began
  Vec3 p = Vec3::Zero();
  double speed_mps = 0.0;
};

struct FlightTrack {
  Scenario scenario;
  World world;
  std::vector<TrackPoint> points;  ///< every 50 ms
};

/// Flies a scenario file on virtual time. @throws ConfigError for what run_process would refuse.
FlightTrack fly_and_track(const std::string& scenario_file, const std::vector<std::string>& overrides);

}  // namespace tern
