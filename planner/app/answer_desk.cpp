#include "planner/app/answer_desk.h"

#include <utility>

#include "messages/channels.h"
#include "planner/planner_build.h"

namespace tern {

Plan unanswered(const HorizonRequest& request) {
  Plan plan;
  plan.request_id = request.id;
  plan.reason = PlanReason::OutOfTime;
  plan.trajectory = request.committed;
  plan.local_goal = request.start.p;
  plan.inputs.request = request.header.name;
  return plan;
}

void AnswerDesk::open(const HorizonRequest& request, UTime now) {
  const std::lock_guard lock(mutex_);
  if (open_) send_incumbent(now);
  Open next;
  next.id = request.id;
  next.arrived = now;
  next.watch_at = request.deadline - kWatchdogLead;
  next.incumbent = unanswered(request);
  open_ = std::move(next);
}

void AnswerDesk::improve(const Plan& plan) {
  const std::lock_guard lock(mutex_);
  if (!open_ || open_->id != plan.request_id) return;
  open_->incumbent = plan;
  ++open_->improvements;
}

bool AnswerDesk::answer(const Plan& plan, const PlanTiming& timing) {
  const std::lock_guard lock(mutex_);
  if (!open_ || open_->id != plan.request_id) return false;
  send(plan, timing);
  open_.reset();
  return true;
}

void AnswerDesk::watch(UTime now) {
  const std::lock_guard lock(mutex_);
  if (open_ && now >= open_->watch_at) send_incumbent(now);
}

std::optional<UTime> AnswerDesk::watch_time() const {
  const std::lock_guard lock(mutex_);
  if (!open_) return std::nullopt;
  return open_->watch_at;
}

void AnswerDesk::send_incumbent(UTime now) {
  Plan plan = std::move(open_->incumbent);
  plan.standing = open_->improvements;
  PlanTiming timing;
  timing.request_id = plan.request_id;
  timing.total_ms = bus_.clock().in_system_time(now - open_->arrived).seconds() * 1e3;
  timing.first_answer_ms = timing.total_ms;
  timing.from_watchdog = true;
  send(std::move(plan), timing);
  open_.reset();
}

void AnswerDesk::send(Plan plan, const PlanTiming& timing) {
  plan.inputs.configuration_hash = configuration_hash_;
  plan.inputs.planner_build = planner_build();
  bus_.publish(channels::kPlan, plan);
  bus_.publish(channels::kPlanTiming, timing);
  if (sent_) sent_(plan);
}

}  // namespace tern
