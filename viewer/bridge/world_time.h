// When world time began, by what a flight's listeners hear.
#pragma once

#include <optional>

#include "core/world/goal.h"
#include "core/world/horizon.h"

namespace tern {

/// World time begins with the first HORIZON_REQUEST. An autopilot is told to hold until it does: there it begins with
/// the first request after the goal to go to.
class WorldTime {
 public:
  void receive(const Goal& message);
  void receive(const HorizonRequest& message);
  /// @return nullopt before it began, or where nobody asked for a plan
  [[nodiscard]] std::optional<UTime> zero() const { return zero_; }

 private:
  bool has_goal_ = false, holds_ = false;  ///< holds: the first goal was to hold or stop, and none to go has come
  UTime not_before_{};                     ///< when the first goal to go was sent, if it was not the first
  std::optional<UTime> zero_;
};

}  // namespace tern
