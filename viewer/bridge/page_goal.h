// A goal sent by a page or by a client of Foxglove.
#pragma once

#include <cstdint>
#include <optional>

#include "core/world/goal.h"
#include "viewer/bridge/scene.h"

namespace tern {

/// Repeats the goal at 1 Hz. It ends when a goal with a larger id arrives, or when another vehicle (a new sender epoch)
/// flies. Pure.
class PageGoal {
 public:
  /// @param goal  published from `now` on
  void set(const Goal& goal, const Scene& scene, UTime now);
  /// Returns the goal if it is time to publish it.
  std::optional<Goal> due(const Scene& scene, UTime now);
  /// Returns the id of a new goal: larger than those of the goals that were set and received. Goals in quick succession
  /// get different ids, although the bus has not told the first one yet.
  [[nodiscard]] std::int64_t next_id(const Scene& scene) const;
  /// Returns the id of the newest goal that was set; 0: none.
  [[nodiscard]] std::int64_t newest_id() const { return newest_id_; }

 private:
  std::optional<Goal> goal_;
  std::int64_t newest_id_ = 0;
  std::int64_t vehicle_us_ = 0;  ///< sender epoch of its vehicle; 0: the first vehicle that is received
  UTime next_{};
};

}  // namespace tern
