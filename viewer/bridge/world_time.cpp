#include "viewer/bridge/world_time.h"

#include <utility>

namespace tern {

void WorldTime::receive(const Goal& message) {
  const bool goes = message.mode == GoalMode::Go;
  if (!std::exchange(has_goal_, true)) holds_ = !goes;
  if (!holds_ || !goes) return;
  holds_ = false;
  not_before_ = message.header.utime;
}

void WorldTime::receive(const HorizonRequest& message) {
  const bool has_begun = !holds_ && message.header.utime >= not_before_;
  if (!zero_ && has_begun) zero_ = message.header.utime;
}

}  // namespace tern
