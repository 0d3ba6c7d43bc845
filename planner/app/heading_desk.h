// The heading desk: sends a PLAN_HEADING after each PLAN that has a trajectory.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "core/world/heading.h"
#include "core/world/horizon.h"
#include "planner/heading/sent_headings.h"
#include "planner/planning_world.h"
#include "runtime/bus.h"

namespace tern {

/// Plans and publishes headings (planner/heading/heading_planner.h). PLAN never waits for it.
///
/// A heading starts with the yaw that the heading of the committed trajectory has at t_s. If this planner sent none for
/// that trajectory, it starts in the direction of flight. Thread-safe.
class HeadingDesk {
 public:
  HeadingDesk(Bus& bus, const HeadingLimits& limits) : bus_(bus), limits_(limits) {}

  /// Planning of a request begins, from these predictions. A null pointer means that there are none.
  void begin(const HorizonRequest& request, std::shared_ptr<const PredictionProducts> predictions);
  /// A plan was published. Its heading is published if its request was begun last, and if it has one.
  void answered(const Plan& plan);

 private:
  Bus& bus_;
  HeadingLimits limits_;
  std::mutex mutex_;
  std::optional<HorizonRequest> request_;
  std::shared_ptr<const PredictionProducts> predictions_;
  SentHeadings sent_;
};

}  // namespace tern
