// A mission: the places that a vehicle flies to, one after the other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/types.h"

namespace tern::mission {

/// The task of the vehicle at a step.
enum class Action : std::uint8_t {
  Pass,    ///< fly past within the radius, without a stop
  Stop,    ///< come to rest there, and stay for hold_s
  Follow,  ///< stay beside a moving track for hold_s
};

/// One step. Its number is its place in the mission, from 0.
struct Step {
  std::string name;  ///< for people: "waypoint 3", "landing"
  int item = 0;      ///< number of the item in the file that it comes from
  Action action = Action::Pass;
  Vec3 position = Vec3::Zero();  ///< W, m; Follow: offset of the vehicle from the track
  double radius = 0.0;           ///< m: Pass counts within it; 0: the configured radius
  double hold_s = 0.0;           ///< Stop, Follow: how long it stays
  std::int64_t track = 0;        ///< Follow: id of the track in PREDICTIONS
  double speed = 0.0;            ///< largest speed on the way there, m/s (velocity_limits()); 0: that of the vehicle
};

struct Mission {
  std::string file;
  std::vector<Step> steps;  ///< ≥ 1, at most kMaxSteps
};

/// A goal's id holds the step's number in kStepBits bits (goal_ids.h).
inline constexpr int kMaxSteps = 4'000;

}  // namespace tern::mission
