// Finds the start of world time from received messages.
#pragma once

#include <optional>

#include "core/world/goal.h"
#include "core/world/horizon.h"

namespace tern {

/// World time starts with the first HORIZON_REQUEST. With an autopilot, the first goal is to hold; then world time
/// starts with the first request after the first goal to go.
class WorldTime {
 public:
  void receive(const Goal& message);
  void receive(const HorizonRequest& message);
  /// Returns the start of world time; nullopt before it, or if nobody requested a plan.
  [[nodiscard]] std::optional<UTime> zero() const { return zero_; }

 private:
  bool has_goal_ = false, holds_ = false;  ///< holds_: the first goal was hold or stop, and no goal to go has followed
  UTime not_before_{};                     ///< when the first goal to go was sent, unless it was the first goal
  std::optional<UTime> zero_;
};

}  // namespace tern
