#include "monitor/request_ledger.h"

#include <algorithm>

namespace tern {
namespace {

std::size_t level_of(const Plan& plan) { return plan.confidence <= 0.0 ? kConfidenceLevels.size() : idx(plan.level); }

}  // namespace

bool RequestLedger::add(const HorizonRequest& request) {
  if (!requests_filter_.is_first(request.header.name)) return false;
  deadlines_[request.id] = request.deadline;
  answered_.erase(request.id);  // the ids of a restarted executor begin at 1 again
  return true;
}

void RequestLedger::add(const Plan& plan) {
  if (!plans_filter_.is_first(plan.header.name)) return;
  if (!answered_.insert(plan.request_id).second) {
    ++second_answers_;
    return;
  }
  if (answered_.size() > DuplicateFilter::kRemembered) answered_.erase(answered_.begin());
  ++plans_[idx(plan.outcome)];
  ++reasons_[idx(plan.reason)];
  if (plan.outcome != PlanOutcome::NoPlan) {
    ++by_level_[level_of(plan)];
    if (plan.confidence > 0.0 && plan.sure_for < kMaxSpan) ++for_a_time_;
  }
  last_reason_ = plan.reason;
  last_left_out_ = plan.inputs.left_out;
  if (last_left_out_ > 0) ++left_out_.plans;
  left_out_.max_tracks = std::max(left_out_.max_tracks, last_left_out_);
  const auto request = deadlines_.find(plan.request_id);
  if (request == deadlines_.end()) return;
  ++settled_;
  if (plan.header.utime <= request->second) ++in_time_;
  deadlines_.erase(request);
}

void RequestLedger::advance(UTime vehicle_time) {
  settled_ += static_cast<std::int64_t>(
      std::erase_if(deadlines_, [&](const auto& request) { return request.second + kAnswerGrace < vehicle_time; }));
}

}  // namespace tern
