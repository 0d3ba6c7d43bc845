// The headings that this planner has sent, so that the next one continues the committed one.
#pragma once

#include <deque>
#include <optional>

#include "core/world/heading.h"
#include "core/world/horizon.h"

namespace tern {

/// Remembers the newest headings with their trajectories.
///
/// The executor adopts a heading with its plan. So the heading in force at t_s is the newest one that was sent for the
/// trajectory that the request names as committed. If the executor has refused it or never received it, it refuses the
/// next heading as well and starts anew with the one after (executor/committed_heading.h).
class SentHeadings {
 public:
  /// @param trajectory  of the plan; for KeepCommitted the committed one
  void add(const TimedSpline& trajectory, const PlanHeading& heading);
  /// Returns the yaw at t_s of the newest heading of the request's committed trajectory; nullopt if there is none.
  [[nodiscard]] std::optional<YawSample> committed_at(const HorizonRequest& request) const;

 private:
  struct Sent {
    TimedSpline trajectory;
    HeadingSpline heading;
  };
  std::deque<Sent> sent_;  ///< the newest last
};

}  // namespace tern
