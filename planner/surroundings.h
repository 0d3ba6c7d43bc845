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
  const std::vector<PlanningObstacle>& obstacles;  ///< in reach; their α is reduced if the start is relaxed
  Box committed;                                   ///< committed_box()
  Assurance assurance;                             ///< the share of α that is applied
  Box free_side;  ///< of the centre, beyond each face that the start touches (leave_touched)
  Box room;       ///< of the centre: the flight box and free_side
  StartClearance start;
  LookAhead look;  ///< no plan lasts beyond look.followed_until
  HoldDemand hold;
  Limits plan_limits;                      ///< the vehicle's, with v_max reduced to velocity_share
  Limits pace_limits;                      ///< per_axis_limits(plan_limits): durations are made by these
  const SemanticFields* fields = nullptr;  ///< null if the semantic cost is the same all over the sphere
};

/// Returns whether the committed trajectory has ended by t_s.
bool is_at_rest(const HorizonRequest& request);
/// Returns t_s minus the end of the committed trajectory, s; negative while it lasts.
double time_at_rest_s(const HorizonRequest& request);
/// Returns whether velocity and acceleration are zero at t_s.
bool is_stationary(const HorizonRequest& request);

/// Returns the surroundings at full assurance. @pre the world has predictions and a map
/// @param memory  keeps the obstacles until the next call
Surroundings surroundings(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config,
                          PlanWorkspace& memory);

/// Changes `near` to this assurance: α of the obstacles in `memory`, the start's clearance, and the holds.
void reduce_assurance(const Assurance& assurance, PlanWorkspace& memory, Surroundings& near);

/// Returns the problem of J intervals of this Δt.
HorizonProblem horizon_problem(const Surroundings& near, Duration interval);

/// Returns whether obstacles are followed for J intervals and a hold of hold_s after them.
bool is_followed(const Surroundings& near, Duration interval, double hold_s);

}  // namespace tern
