// The heading desk: sends a PLAN_HEADING after each PLAN that has a trajectory.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "core/world/heading.h"
#include "core/world/horizon.h"
#include "planner/heading/heading_search.h"
#include "planner/heading/sent_headings.h"
#include "planner/planning_world.h"
#include "runtime/bus.h"

namespace tern {

/// Returns plan_heading() for the tracks of a world, with `planner.unseen: passive` and `unseen_movers.looks` for its
/// unseen space, and with an error price for its texture.
std::optional<PlanHeading> plan_heading_in(const PlanningWorld& world, const HorizonRequest& request, const Plan& plan,
                                           const PlannerConfig& config, const HeadingLimits& limits,
                                           const HeadingStart& start);

/// Plans and publishes headings (planner/heading/heading_planner.h). PLAN never waits for it.
///
/// A heading starts with the yaw that the heading of the committed trajectory has at t_s. If this planner sent none for
/// that trajectory, it starts in the direction of flight. Thread-safe.
class HeadingDesk {
 public:
  HeadingDesk(Bus& bus, const PlannerConfig& config, const HeadingLimits& limits)
      : bus_(bus), config_(config), limits_(limits) {}

  /// Planning of a request begins, in this world.
  void begin(const HorizonRequest& request, const PlanningWorld& world);
  /// A plan was published. Its heading is published if its request was begun last, and if it has one.
  void answered(const Plan& plan);

 private:
  Bus& bus_;
  PlannerConfig config_;
  HeadingLimits limits_;
  std::mutex mutex_;
  std::optional<HorizonRequest> request_;
  PlanningWorld world_;
  SentHeadings sent_;
};

}  // namespace tern
