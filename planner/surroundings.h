// The surroundings of one request: the same for all its attempts.
#pragma once

#include <vector>

#include "core/world/horizon.h"
#include "planner/assurance.h"
#include "planner/hold.h"
#include "planner/look_ahead.h"
#include "planner/planning_world.h"
#include "planner/problem/horizon_problem.h"
#include "planner/problem/planner_config.h"
#include "planner/start_clearance.h"

namespace tern {

struct PlanWorkspace;

struct Surroundings {
  const HorizonRequest& request;
  const PlannerConfig& config;
  /// In reach, with the α of `assurance`, which is smaller if the start is relaxed.
  const std::vector<PlanningObstacle>& obstacles;
  Box committed;                ///< committed_box()
  Assurance assurance;          ///< the share of α that is applied
  double set_confidence = 0.0;  ///< of the prediction set, [0, 1]
  Box free_side;                ///< of the centre, beyond each face that the start touches (leave_touched)
  Box room;                     ///< of the centre: the flight box and free_side
  StartClearance start;
  LookAhead look;  ///< no plan lasts beyond look.followed_until
  HoldDemand hold;
  Limits plan_limits;                       ///< the vehicle's, with v_max reduced to velocity_share
  Limits pace_limits;                       ///< per_axis_limits(plan_limits): durations are made by these
  const SemanticFields* fields = nullptr;   ///< null if the semantic cost is the same all over the sphere
  const UnseenKnowledge* unseen = nullptr;  ///< null with `planner.unseen: ignore`
};

/// Returns whether the committed trajectory has ended by t_s.
bool is_at_rest(const HorizonRequest& request);
/// Returns t_s minus the end of the committed trajectory, s; negative while it lasts.
double time_at_rest_s(const HorizonRequest& request);
/// Returns whether velocity and acceleration are zero at t_s.
bool is_stationary(const HorizonRequest& request);

/// Returns the surroundings at full assurance. @pre the world has predictions and a map
/// @param memory  keeps the obstacles until the next call of this function
Surroundings surroundings(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config,
                          PlanWorkspace& memory);

/// Returns the surroundings at this assurance: α of the obstacles, the clearance of the start, and the holds are made
/// anew. `near` stays as it is.
/// @param near    at full assurance
/// @param memory  keeps the obstacles until the next call with a reduced assurance
Surroundings at_assurance(const Assurance& assurance, const Surroundings& near, PlanWorkspace& memory);

/// Returns the problem of J intervals of this Δt.
HorizonProblem horizon_problem(const Surroundings& near, Duration interval);

/// Returns whether obstacles are followed for J intervals and a hold of hold_s after them.
bool is_followed(const Surroundings& near, Duration interval, double hold_s);

}  // namespace tern
