// Counts requests and their answers.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>

#include "core/world/horizon.h"
#include "core/world/track.h"
#include "monitor/duplicate_filter.h"

namespace tern {

/// An answer may arrive this long after the request's deadline, because messages of different processes may overtake
/// each other.
inline constexpr Duration kAnswerGrace{200'000};

/// Plans made without all tracks, because predictions or declared motions did not fit into their sets.
struct LeftOut {
  std::int64_t plans = 0;       ///< made from an incomplete set
  std::int32_t max_tracks = 0;  ///< largest number left out of one set
};

/// First answers with a trajectory, by certified confidence: the levels of kConfidenceLevels, then those without a
/// number.
using PlansByLevel = std::array<std::int64_t, kConfidenceLevels.size() + 1>;

/// Matches PLAN with HORIZON_REQUEST by the request's id.
///
/// | event                                     | effect                                              |
/// |-------------------------------------------|-----------------------------------------------------|
/// | first answer to a request                 | the request is settled; the answer counts as a plan |
/// | kAnswerGrace after the deadline           | the request is settled without an answer            |
/// | further answer (usually a second planner) | counted in second_answers() only                    |
/// | answer to a request that was not received | counts as a plan                                    |
/// | repeated delivery of a message            | ignored                                             |
///
/// Only settled requests are counted, so that no request is half open at the flight's end. An answer is in time if it
/// was published (header.utime) by the deadline.
class RequestLedger {
 public:
  /// @return false for a repeated delivery
  bool add(const HorizonRequest& request);
  void add(const Plan& plan);
  /// @param vehicle_time  the vehicle's clock
  void advance(UTime vehicle_time);

  [[nodiscard]] std::int64_t requests() const { return settled_; }
  [[nodiscard]] std::int64_t answered_in_time() const { return in_time_; }
  [[nodiscard]] std::int64_t second_answers() const { return second_answers_; }
  [[nodiscard]] std::int64_t plans(PlanOutcome outcome) const { return plans_[idx(outcome)]; }
  [[nodiscard]] std::int64_t plans(PlanReason reason) const { return reasons_[idx(reason)]; }
  [[nodiscard]] const PlansByLevel& plans_by_level() const { return by_level_; }
  /// Plans whose confidence holds for a limited time only (Plan::sure_for).
  [[nodiscard]] std::int64_t plans_for_a_time() const { return for_a_time_; }
  /// Reason of the newest first answer; None before it.
  [[nodiscard]] PlanReason last_reason() const { return last_reason_; }
  /// Number of tracks left out of the newest plan's predictions.
  [[nodiscard]] std::int32_t last_left_out() const { return last_left_out_; }
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }

 private:
  DuplicateFilter requests_filter_, plans_filter_;
  std::map<std::int64_t, UTime> deadlines_;  ///< deadlines of open requests, by id
  std::set<std::int64_t> answered_;          ///< the newest answered requests
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
