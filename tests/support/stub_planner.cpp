#include "tests/support/stub_planner.h"

#include "messages/codec.h"

namespace tern {

StubPlannerNode::StubPlannerNode(Bus& bus, const StubPlannerOptions& options) : bus_(bus), options_(options) {
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) {
    if (!goal_ || goal.id > goal_->id) goal_ = goal;
  });
  bus_.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& request) {
    pending_.push_back({request, bus_.clock().now() + options_.delay});
  });
}

UTime StubPlannerNode::next_wakeup() const { return pending_.empty() ? kNever : pending_.front().answer_at; }

void StubPlannerNode::step(UTime now) {
  while (!pending_.empty() && pending_.front().answer_at <= now) {
    const HorizonRequest request = pending_.front().request;
    pending_.pop_front();
    Plan plan;
    plan.request_id = request.id;
    plan.inputs.request = request.header.name;
    plan.reason = PlanReason::StaleWorld;
    if (goal_) plan = straight_plan(request, goal_->position, options_.plan);
    for (int k = 0; k < options_.answers; ++k) bus_.publish(channels::kPlan, plan);
  }
}

}  // namespace tern
