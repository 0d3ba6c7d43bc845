#include "monitor/request_ledger.h"

#include <algorithm>

namespace tern {

void RequestLedger::add(const HorizonRequest& request) { deadlines_[request.id] = request.deadline; }

void RequestLedger::add(const Plan& plan) {
  ++plans_[static_cast<std::size_t>(plan.outcome)];
  ++reasons_[static_cast<std::size_t>(plan.reason)];
  last_reason_ = plan.reason;
  last_left_out_ = plan.inputs.left_out;
  if (last_left_out_ > 0) ++left_out_.plans;
  left_out_.most_tracks = std::max(left_out_.most_tracks, last_left_out_);
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
