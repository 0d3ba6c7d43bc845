// Goals of ROS as GOAL: when each is sent, and with which id.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/time.h"
#include "core/world/goal.h"

namespace tern::ros {

/// A goal is sent at once, but two goals are at least kSpacing apart. It is repeated at 1 Hz until another process, the
/// executor, repeats it. Asking for the same position again makes no new goal. A goal of another sender with a larger
/// id ends the repetition.
class GoalSender {
 public:
  static constexpr Duration kSpacing{100'000}, kRepeat{1'000'000};

  /// Takes a position. Of several within kSpacing the last one is sent.
  void ask(const Vec3& position);
  /// Takes a GOAL of the bus. @param own  whether this process sent it
  void hear(const Goal& goal, bool own);
  /// Returns the goal to be sent now, if there is one.
  std::optional<Goal> due(UTime now);

 private:
  std::optional<Vec3> asked_;
  std::optional<Goal> goal_;   ///< sent, and not heard from another process yet
  std::optional<Goal> heard_;  ///< with the largest id
  UTime sent_;
};

}  // namespace tern::ros
