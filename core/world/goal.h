// The message GOAL: where to fly. It is sent on demand and repeated at 1 Hz.
#pragma once

#include <cstdint>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// The task of the vehicle.
enum class GoalMode : std::uint8_t {
  Go = 0,    ///< fly to the position and rest there
  Hold = 1,  ///< come to rest at the end of the committed trajectory; evade approaching obstacles
  Stop = 2,  ///< come to rest at the end of the committed trajectory; request no plans
};

struct Goal {
  Header header;
  std::int64_t id = 0;  ///< > 0; every new goal has a larger id
  GoalMode mode = GoalMode::Go;
  Vec3 position = Vec3::Zero();  ///< W, m
};

/// Whether two goals ask for the same, whatever their ids and headers.
inline bool same_goal(const Goal& a, const Goal& b) {
  return a.mode == b.mode && a.position.x() == b.position.x() && a.position.y() == b.position.y() &&
         a.position.z() == b.position.z();
}

}  // namespace tern
