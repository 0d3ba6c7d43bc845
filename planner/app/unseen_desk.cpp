#include "planner/app/unseen_desk.h"

#include <utility>

#include "core/world/body.h"
#include "messages/channels.h"

namespace tern {

void UnseenDesk::begin(const HorizonRequest& request, std::shared_ptr<const UnseenKnowledge> known) {
  const std::lock_guard lock(mutex_);
  request_ = request;
  known_ = std::move(known);
}

void UnseenDesk::answered(const Plan& plan) {
  const std::lock_guard lock(mutex_);
  if (!request_ || request_->header.name != plan.inputs.request) return;
  PlanUnseen unseen;
  unseen.request_id = plan.request_id;
  unseen.request = plan.inputs.request;
  unseen.start = request_->t_s;
  unseen.committed_clear = clear_of(request_->committed);
  const bool is_new = plan.outcome != PlanOutcome::NoPlan && plan.outcome != PlanOutcome::KeepCommitted;
  unseen.plan_clear = is_new ? clear_of(plan.trajectory) : unseen.committed_clear;
  bus_.publish(channels::kPlanUnseen, unseen);
}

Duration UnseenDesk::clear_of(const TimedSpline& trajectory) const {
  const double radius = upright_radius(grown(request_->body, request_->tube));
  const double contact_s = first_contact(*known_, trajectory, request_->t_s, radius);
  return contact_s == kNoContact ? kMaxSpan : Duration::from_seconds(contact_s);
}

}  // namespace tern
