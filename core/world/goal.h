// GOAL: where to fly, sent on demand and repeated at 1 Hz.
#pragma once

#include <cstdint>

#include "core/base/types.h"
#include "core/world/header.h"

namespace tern {

enum class GoalMode : std::uint8_t {
  Go = 0,    ///< fly to the position and rest there
  Hold = 1,  ///< come to rest by the committed trajectory and stay, evading what closes in
  Stop = 2,  ///< come to rest by the committed trajectory and ask for no more plans
};

struct Goal {
  Header header;
  std::int64_t id = 0;  ///< > 0; a new goal has a new, larger id
  GoalMode mode = GoalMode::Go;
  Vec3 position = Vec3::Zero();  ///< W, m
};

}  // namespace tern
