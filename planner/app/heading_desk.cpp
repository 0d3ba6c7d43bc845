#include "planner/app/heading_desk.h"

#include <utility>

#include "messages/channels.h"
#include "planner/heading/heading_planner.h"
#include "planner/heading/texture_term.h"

namespace tern {

std::optional<PlanHeading> plan_heading_in(const PlanningWorld& world, const HorizonRequest& request, const Plan& plan,
                                           const HeadingLimits& limits, const HeadingStart& start) {
  static const std::vector<Track> kNone;
  const std::vector<Track>& tracks = world.predictions ? world.predictions->set.tracks : kNone;
  const bool knows_texture = world.map && world.map->error_price > 0.0 && world.goal && world.goal->field &&
                             world.goal->field->cost().information;
  if (!knows_texture) return plan_heading(request, plan, tracks, limits, start);
  const TextureTerm texture(*world.goal->field->cost().information, world.map->error_price);
  return plan_heading(request, plan, tracks, limits, start, &texture);
}

void HeadingDesk::begin(const HorizonRequest& request, const PlanningWorld& world) {
  const std::lock_guard lock(mutex_);
  request_ = request;
  world_ = world;
}

void HeadingDesk::answered(const Plan& plan) {
  const std::lock_guard lock(mutex_);
  if (!request_ || request_->header.name != plan.inputs.request || plan.outcome == PlanOutcome::NoPlan) return;
  auto at = sent_.committed_at(*request_);
  if (!at) at = flight_direction(*request_, plan);
  if (!at) return;
  const auto heading = plan_heading_in(world_, *request_, plan, limits_, heading_start(*at, plan.trajectory.interval));
  if (!heading) return;
  sent_.add(plan.trajectory, *heading);
  bus_.publish(channels::kPlanHeading, *heading);
}

}  // namespace tern
