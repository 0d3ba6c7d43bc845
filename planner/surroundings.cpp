#include "planner/surroundings.h"

#include "core/world/flyable.h"
#include "planner/plan_workspace.h"
#include "planner/safety/thrust_set.h"

namespace tern {
namespace {

/// Collects the tracks and map boxes in the region. For a vehicle that estimates its pose, a box of the map is grown by
/// the largest margin of the part of it that may be in the region.
void find_obstacles(const Box& region, const PlanningWorld& world, PlanWorkspace& memory) {
  memory.obstacles.clear();
  world.predictions->index.query(region, memory.found);
  for (const std::int32_t k : memory.found) {
    memory.obstacles.push_back(world.predictions->obstacles[idx(k)]);
  }
  const std::optional<PoseError>& error = world.predictions->set.pose_error;
  const Box reached = error ? grown(region, Vec3::Constant(error->margin(region))) : region;
  world.map->occupied.query(reached, memory.found);
  for (const std::int32_t k : memory.found) {
    const Box& box = world.map->occupied.boxes()[idx(k)];
    const double margin = error ? error->margin(box.intersection(reached)) : 0.0;
    memory.obstacles.push_back(
        {-1 - static_cast<std::int64_t>(k), nullptr, grown(box, Vec3::Constant(margin)), {}, nullptr, margin});
  }
}

/// Returns the fields if their cost varies within the sphere, else null. The mean distance of Eq. 3 varies everywhere.
const SemanticFields* semantics_in_reach(const HorizonRequest& request, const SemanticFields& fields,
                                         const PlannerConfig& config) {
  if (!config.semantics) return nullptr;
  const Box sphere = box_around(request.start.p, Vec3::Constant(config.sphere_radius_m));
  const bool differs =
      config.semantic_cost == SemanticCost::MeanDistance ? fields.has_weight() : fields.varies_in(sphere);
  return differs ? &fields : nullptr;
}

/// Returns null if unseen movers are ignored.
const UnseenKnowledge* unseen_of(const PlanningWorld& world, const PlannerConfig& config) {
  static const UnseenKnowledge kNothing;
  if (config.unseen == UnseenMode::Ignore) return nullptr;
  return world.unseen ? world.unseen.get() : &kNothing;
}

}  // namespace

Surroundings surroundings(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config,
                          PlanWorkspace& memory) {
  const Box committed = committed_box(request);
  const Box region = planning_region(request, config, committed);
  find_obstacles(region, world, memory);
  const Box free_side = leave_touched(memory.obstacles, request.body, request.start.p);
  const StartClearance start = clear_start(memory.obstacles, request.body, request.start.p, request.t_s);
  const LookAhead look = look_ahead(request.t_s, *world.predictions, region);
  Limits plan_limits = request.limits;
  plan_limits.v_max *= config.velocity_share;
  return {request,
          config,
          memory.obstacles,
          committed,
          {},
          world.predictions->set.confidence,
          free_side,
          centre_box(request.flight_box, request.body).intersection(free_side),
          start,
          look,
          hold_demand(request, config, memory.obstacles, look.horizon_s),
          plan_limits,
          per_axis_limits(plan_limits),
          semantics_in_reach(request, world.map->fields, config),
          unseen_of(world, config)};
}

Surroundings at_assurance(const Assurance& assurance, const Surroundings& near, PlanWorkspace& memory) {
  if (is_full(assurance)) return near;
  const HorizonRequest& request = near.request;
  std::vector<PlanningObstacle>& obstacles = memory.reduced_obstacles;
  obstacles = near.obstacles;
  apply_assurance(assurance, request.t_s, obstacles);
  const StartClearance start = clear_start(obstacles, request.body, request.start.p, request.t_s);
  return {request,
          near.config,
          obstacles,
          near.committed,
          assurance,
          near.set_confidence,
          near.free_side,
          near.room,
          start,
          near.look,
          hold_demand(request, near.config, obstacles, near.look.horizon_s),
          near.plan_limits,
          near.pace_limits,
          near.fields,
          near.unseen};
}

HorizonProblem horizon_problem(const Surroundings& near, Duration interval) {
  return {near.request.start,  near.config.intervals,    interval,
          near.request.limits, near.plan_limits,         near.config.sphere_radius_m,
          near.room,           near.request.body.radius, near.config.hull_basis};
}

bool is_followed(const Surroundings& near, Duration interval, double hold_s) {
  const Duration looks = interval * near.config.intervals + Duration::from_seconds(hold_s);
  return near.request.t_s + looks <= near.look.followed_until;
}

bool is_at_rest(const HorizonRequest& request) { return request.t_s >= request.committed.end(); }

double time_at_rest_s(const HorizonRequest& request) { return (request.t_s - request.committed.end()).seconds(); }

bool is_stationary(const HorizonRequest& request) { return request.start.v.isZero() && request.start.a.isZero(); }

}  // namespace tern
