// Requests and their answers, as the wire shows them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>

#include "core/world/horizon.h"
#include "core/world/track.h"
#include "monitor/duplicate_filter.h"

namespace tern {

/// How long after its deadline a request's answer is still waited for: messages of several processes may overtake each
/// other.
inline constexpr Duration kAnswerGrace{200'000};

/// What plans did not know of, because predictions or declared motions did not fit into their sets.
struct LeftOut {
  std::int64_t plans = 0;        ///< that rest on an incomplete set
  std::int32_t most_tracks = 0;  ///< left out of one set
};

/// First answers with a trajectory, by the confidence that they are certified at: the levels of kConfidenceLevels, then
/// those without a number.
using PlansByLevel = std::array<std::int64_t, kConfidenceLevels.size() + 1>;

/// Matches PLAN with HORIZON_REQUEST by the request's id. A request is settled when its first answer came, or
/// kAnswerGrace after its deadline. Only settled ones are counted, so that the flight's end leaves no request half
/// open. What the network delivers twice counts once.
class RequestLedger {
 public:
  void add(const HorizonRequest& request);
  /// The first answer settles its request and is counted among the plans, as is an answer to a request that was not
  /// heard. A further one (of a second planner, as a rule) is counted as such and nowhere else. In time: published
  /// (header.utime) by the deadline.
  void add(const Plan& plan);
  /// The vehicle's clock has come so far.
  void advance(UTime vehicle_time);

  [[nodiscard]] std::int64_t requests() const { return settled_; }
  [[nodiscard]] std::int64_t answered_in_time() const { return in_time_; }
  [[nodiscard]] std::int64_t second_answers() const { return second_answers_; }
  [[nodiscard]] std::int64_t plans(PlanOutcome outcome) const { return plans_[idx(outcome)]; }
  [[nodiscard]] std::int64_t plans(PlanReason reason) const { return reasons_[idx(reason)]; }
  [[nodiscard]] const PlansByLevel& plans_by_level() const { return by_level_; }
  /// Of those with a number, how many have it for a time only (Plan::sure_for).
  [[nodiscard]] std::int64_t plans_for_a_time() const { return for_a_time_; }
  /// The newest first answer's; None before it.
  [[nodiscard]] PlanReason last_reason() const { return last_reason_; }
  /// Tracks that the newest plan's predictions had left out.
  [[nodiscard]] std::int32_t last_left_out() const { return last_left_out_; }
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }

 private:
  DuplicateFilter requests_filter_, plans_filter_;
  std::map<std::int64_t, UTime> deadlines_;  ///< of open requests, by id
  std::set<std::int64_t> answered_;          ///< requests that have their answer, the newest
  std::int64_t settled_ = 0, in_time_ = 0, second_answers_ = 0;
  std::array<std::int64_t, kPlanOutcomes> plans_ = {};
  std::array<std::int64_t, kPlanReasons> reasons_ = {};
  PlansByLevel by_level_ = {};
  std::int64_t for_a_time_ = 0;
  PlanReason last_reason_ = PlanReason::None;
  std::int32_t last_left_out_ = 0;
  LeftOut left_out_;
};

}  // namespace tern
