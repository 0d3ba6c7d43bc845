// A flight in numbers: what is printed and written when it has ended.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/percentiles.h"
#include "core/world/flight_result.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "monitor/process_table.h"
#include "monitor/request_ledger.h"

namespace tern {

/// What PLAN_TIMING measures, by percentile; ms. A stage's are over the answers in which it ran.
struct ReplanTimes {
  Percentiles total;         ///< from the request's arrival to the answer
  Percentiles first_answer;  ///< until the first certified trajectory
  Percentiles hulls;         ///< of Stage::BroadPhase; its key is older than that name
  Percentiles search, optimization, check;
};

/// What the scenario, with its overrides, asked of the vehicle.
struct FlownSettings {
  Limits limits;
  double lambda_attractive = 0.0, lambda_repulsive = 0.0;  ///< 0: semantics are off
};

struct FlightSummary {
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;  ///< why, in words; may be empty
  std::string scenario;
  std::optional<std::uint64_t> seed;  ///< nothing when the scenario could not be read
  std::optional<std::int64_t> count;  ///< obstacles of the world's generator; the same
  std::optional<FlownSettings> settings;
  std::optional<FlightResult> result;  ///< the referee's measures; nullopt if it gave none
  std::int64_t requests = 0, answered_in_time = 0;
  std::int64_t second_answers = 0;                      ///< to requests that had their answer: two planners
  std::array<std::int64_t, kPlanOutcomes> plans = {};   ///< first answers, by PlanOutcome
  std::array<std::int64_t, kPlanReasons> reasons = {};  ///< of the plans, by PlanReason; not in the JSON
  PlansByLevel by_level = {};
  std::int64_t for_a_time = 0;  ///< of them, RequestLedger::plans_for_a_time
  LeftOut left_out;
  ReplanTimes replan_ms;
  std::map<std::string, MessageCount> messages;  ///< by channel
  std::int64_t restarts = 0;
  std::map<std::string, int> beside;  ///< processes of which several lived at a time, and how many at most
  std::string log;                    ///< path of the recording; empty: none
  std::string command;                ///< what the user typed; empty: not known
  std::string version;                ///< build id
};

/// One JSON object, two spaces of indent. What has no value (NaN, a measure that no referee gave) is null. Its keys:
///
///     outcome, detail, scenario, seed, count, settings, flight_time_s, first_entry_s, path_length_m, mean_speed_mps,
///     top_speed_mps, stops, min_clearance_m, min_map_clearance_m, limit_violations, contacts_moving, contacts_at_rest,
///     obstacles, obstacles_left_out, requests, answered_in_time, second_answers, plans, confidence, left_out,
///     replan_ms, exposure, messages, restarts, beside, log, command, version
std::string to_json(const FlightSummary& summary);

/// The same for a person, at most 34 lines of at most 100 characters while there are at most 6 regions.
std::string to_text(const FlightSummary& summary);

}  // namespace tern
