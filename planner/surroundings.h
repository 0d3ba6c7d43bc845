// What one request plans among: the same for all its attempts.
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
  const std::vector<PlanningObstacle>& obstacles;  ///< in reach; α scaled where the start lies inside
  Box committed;                                   ///< committed_box()
  Assurance assurance;                             ///< what counts of α
  StartClearance start;
  LookAhead look;  ///< no plan looks past its followed_until
  HoldDemand hold;
  Limits plan_limits;                      ///< v_max reduced to velocity_share
  Limits pace_limits;                      ///< per_axis_limits(plan_limits): by which durations are made
  const SemanticFields* fields = nullptr;  ///< null: nothing that they cost differs anywhere in the sphere
};

/// Whether what is committed has ended by then …
bool is_at_rest(const HorizonRequest& request);
/// … and since when, s; negative before.
double time_at_rest_s(const HorizonRequest& request);
/// Neither moves nor is about to.
bool is_stationary(const HorizonRequest& request);

/// @pre the world has predictions and a map. @param memory  keeps the obstacles until the next call
Surroundings surroundings(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config,
                          PlanWorkspace& memory);

/// The same among obstacles of which less counts.
void reduce_assurance(const Assurance& assurance, PlanWorkspace& memory, Surroundings& near);

/// The problem of J intervals of this Δt.
HorizonProblem horizon_problem(const Surroundings& near, Duration interval);

/// Whether obstacles are known to the end of a hold of hold_s after J intervals.
bool is_followed(const Surroundings& near, Duration interval, double hold_s);

}  // namespace tern
