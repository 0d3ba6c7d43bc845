#include "planner/app/heading_desk.h"

#include <utility>
#include <vector>

#include "messages/channels.h"
#include "planner/heading/heading_planner.h"
#include "planner/heading/texture_term.h"
#include "planner/heading/unseen_term.h"

namespace tern {

namespace {

/// Returns the boxes of tracks and map that end the sight from a plan.
std::vector<Box> known_boxes(const PlanningWorld& world, const HorizonRequest& request, const Plan& plan) {
  std::vector<Box> boxes;
  if (world.predictions) {
    for (const Track& track : world.predictions->set.tracks) {
      boxes.push_back(box_around(track.bounds(request.t_s, request.t_s).center(), track.half_extents));
    }
  }
  if (world.map) {
    const Points& points = plan.trajectory.control_points;
    const Vec3 sight = Vec3::Constant(UnseenField::kFarthest);
    const Box region(points.rowwise().minCoeff() - sight, points.rowwise().maxCoeff() + sight);
    for (const std::int32_t k : world.map->occupied.query(region)) boxes.push_back(world.map->occupied.boxes()[idx(k)]);
  }
  return boxes;
}

}  // namespace

std::optional<PlanHeading> plan_heading_in(const PlanningWorld& world, const HorizonRequest& request, const Plan& plan,
                                           const PlannerConfig& config, const HeadingLimits& limits,
                                           const HeadingStart& start) {
  static const std::vector<Track> kNone;
  const std::vector<Track>& tracks = world.predictions ? world.predictions->set.tracks : kNone;
  const bool knows_texture = world.map && world.map->error_price > 0.0 && world.goal && world.goal->field &&
                             world.goal->field->cost().information;
  LookReasons reasons;
  std::optional<TextureTerm> texture;
  if (knows_texture) {
    reasons.texture = &texture.emplace(*world.goal->field->cost().information, world.map->error_price);
  }
  std::optional<UnseenTerm> unseen;
  const bool looks = config.unseen == UnseenMode::Passive && config.unseen_movers.looks;
  if (looks && world.unseen && world.unseen->field) {
    reasons.unseen =
        &unseen.emplace(*world.unseen, known_boxes(world, request, plan), upright_radius(request.body), request.limits);
    reasons.looks_around = looks_around(request, plan, config.unseen_movers.wait_s);
  }
  return plan_heading(request, plan, tracks, limits, start, reasons);
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
  const auto heading =
      plan_heading_in(world_, *request_, plan, config_, limits_, heading_start(*at, plan.trajectory.interval));
  if (!heading) return;
  sent_.add(plan.trajectory, *heading);
  bus_.publish(channels::kPlanHeading, *heading);
}

}  // namespace tern
