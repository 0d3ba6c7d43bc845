// The message SPEED_LIMIT: how fast to fly to a goal. It is sent with the GOAL, and repeated with it.
#pragma once

#include <cstdint>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// Holds while the newest GOAL has this id.
struct SpeedLimit {
  Header header;
  std::int64_t goal_id = 0;   ///< of GOAL, > 0
  Vec3 v_max = Vec3::Ones();  ///< largest |velocity| per axis of W, m/s; lower ones of the vehicle stay
};

}  // namespace tern
