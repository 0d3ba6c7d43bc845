// A goal that a page has sent.
#pragma once

#include <cstdint>
#include <optional>

#include "core/world/goal.h"
#include "viewer/bridge/scene.h"

namespace tern {

/// It is repeated at 1 Hz until somebody sends a goal with a larger id, or another vehicle (a new sender epoch) flies.
/// Pure.
class PageGoal {
 public:
  /// @param goal  to be sent from `now` on
  void set(const Goal& goal, const Scene& scene, UTime now);
  /// What to send now, if anything.
  std::optional<Goal> due(const Scene& scene, UTime now);

 private:
  std::optional<Goal> goal_;
  std::int64_t vehicle_us_ = 0;  ///< the vehicle that it is for; 0: the first that is heard
  UTime next_{};
};

}  // namespace tern
