// The heading of a plan: where the vehicle looks while it flies.
#pragma once

#include <optional>
#include <vector>

#include "core/world/heading.h"
#include "core/world/horizon.h"
#include "core/world/track.h"
#include "planner/heading/heading_search.h"

namespace tern {

/// Returns the first two control points of a heading with this yaw, in (−π, π], and rate.
HeadingStart heading_start(const YawSample& at, Duration interval);

/// Returns the yaw of a heading that follows none, at rate 0. It is the direction of flight at t_s. A slow vehicle
/// takes the direction to the first place of its plan that is kNearestPlace away, or to its local goal.
/// @return nullopt if the plan stays where it is, so that no direction is better than another
std::optional<YawSample> flight_direction(const HorizonRequest& request, const Plan& plan);

/// The terms that not every flight has.
struct LookReasons {
  const LookTerm* texture = nullptr;  ///< null: none
  const LookTerm* unseen = nullptr;   ///< null: none
  bool looks_around = false;          ///< looks_around()
};

/// Returns whether a vehicle looks around before it moves again: the plan stays at rest, and at most kLooksAroundShare
/// of `wait_s` (UnseenMovers) has passed. After that there is time to look ahead again.
bool looks_around(const HorizonRequest& request, const Plan& plan, double wait_s);

/// Plans the heading of a plan from t_s on, with the plan's number and length of intervals. After KeepCommitted it
/// looks along what is left of the committed trajectory. Pure and deterministic.
///
/// 1. At the Greville abscissa of each control point, each term names the directions that are worth looking at. Terms:
///    the way ahead (path_term.h), tracks (track_term.h), unseen space (unseen_term.h), texture (texture_term.h).
///    With texture, all others are left out for sensors that see all round (limits.view_deg = 360). A vehicle that
///    looks around leaves out the way ahead.
/// 2. search_heading() finds the yaw that misses least.
/// 3. The terms are evaluated along it: their values are in the message.
///
/// @param tracks  those of the predictions that the plan names; empty without predictions
/// @return nullopt for NoPlan, and if search_heading() finds none. The header is empty
std::optional<PlanHeading> plan_heading(const HorizonRequest& request, const Plan& plan,
                                        const std::vector<Track>& tracks, const HeadingLimits& limits,
                                        const HeadingStart& start, const LookReasons& reasons = {});

}  // namespace tern
