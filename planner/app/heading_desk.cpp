#include "planner/app/heading_desk.h"

#include <utility>

#include "messages/channels.h"
#include "planner/heading/heading_planner.h"

namespace tern {

void HeadingDesk::begin(const HorizonRequest& request, std::shared_ptr<const PredictionProducts> predictions) {
  const std::lock_guard lock(mutex_);
  request_ = request;
  predictions_ = std::move(predictions);
}

void HeadingDesk::answered(const Plan& plan) {
  const std::lock_guard lock(mutex_);
  if (!request_ || request_->header.name != plan.inputs.request || plan.outcome == PlanOutcome::NoPlan) return;
  auto at = sent_.committed_at(*request_);
  if (!at) at = flight_direction(*request_, plan);
  if (!at) return;
  static const std::vector<Track> kNone;
  const std::vector<Track>& tracks = predictions_ ? predictions_->set.tracks : kNone;
  const auto heading = plan_heading(*request_, plan, tracks, limits_, heading_start(*at, plan.trajectory.interval));
  if (!heading) return;
  sent_.add(plan.trajectory, *heading);
  bus_.publish(channels::kPlanHeading, *heading);
}

}  // namespace tern
