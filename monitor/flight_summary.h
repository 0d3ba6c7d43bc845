// The summary of a flight, printed and written when it has ended.
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
#include "monitor/flight_cause.h"
#include "monitor/process_table.h"
#include "monitor/request_ledger.h"

namespace tern {

/// Percentiles of the times in PLAN_TIMING, ms. A stage's times are those of the answers in which it ran.
struct ReplanTimes {
  Percentiles total;         ///< from the request's arrival to the answer
  Percentiles first_answer;  ///< until the first certified trajectory
  Percentiles hulls;         ///< Stage::BroadPhase; "hulls" is its key in the JSON
  Percentiles search, optimization, check;
};

/// The settings of the vehicle in the scenario with its overrides.
struct FlownSettings {
  Limits limits;
  double lambda_attractive = 0.0, lambda_repulsive = 0.0;  ///< 0: semantics are off
};

/// All numbers of a flight's summary.
struct FlightSummary {
  FlightOutcome outcome = FlightOutcome::Failed;
  std::string detail;       ///< why, in words; may be empty
  Explanation explanation;  ///< the cause and a remedy; empty if the goal was reached
  std::optional<std::string>
      recording;  ///< why it is incomplete; empty: it is whole; nullopt: no tern-logger was heard
  std::string scenario;
  std::optional<std::uint64_t> seed;  ///< nullopt if the scenario could not be read
  std::optional<std::int64_t> count;  ///< obstacles of the world's generator; nullopt as for the seed
  std::optional<FlownSettings> settings;
  std::optional<FlightResult> result;  ///< the referee's measures; nullopt if it published none
  std::int64_t requests = 0, answered_in_time = 0;
  std::int64_t second_answers = 0;                      ///< further answers to answered requests: a second planner runs
  std::array<std::int64_t, kPlanOutcomes> plans = {};   ///< first answers, by PlanOutcome
  std::array<std::int64_t, kPlanReasons> reasons = {};  ///< reasons of the plans, by PlanReason; not in the JSON
  PlansByLevel by_level = {};
  std::int64_t for_a_time = 0;  ///< RequestLedger::plans_for_a_time
  LeftOut left_out;
  /// Share of the time in which the committed trajectory was certified against unseen movers (CertifiedShare); nullopt
  /// with `planner.unseen: ignore`.
  std::optional<double> passively_safe_share;
  ReplanTimes replan_ms;
  std::map<std::string, MessageCount> messages;  ///< by channel
  std::int64_t restarts = 0;
  std::map<std::string, std::string> said;  ///< ProcessTable::words at the end
  std::map<std::string, int> concurrent;    ///< for a process that ran several times at once: the largest number at a
                                            ///< time
  std::string log;                          ///< path of the recording; empty: none
  std::string command;                      ///< command line of the user; empty: not known
  double pace = 1.0;                        ///< seconds of flight per second of the system's clock, which replan_ms has
  std::string version;                      ///< build id
};

/// One JSON object, two spaces of indent. Values that are missing (NaN, a measure without a referee) are null. Its
/// keys:
///
///     outcome, detail, cause, why, recording, scenario, seed, count, settings, flight_time_s, first_entry_s,
///     path_length_m, mean_speed_mps, top_speed_mps, stops, min_clearance_m, min_map_clearance_m, limit_violations,
///     contacts_moving, contacts_at_rest, obstacles, obstacles_left_out, requests, answered_in_time, second_answers,
///     plans, confidence, left_out, passively_safe_share, replan_ms, exposure, messages, restarts, beside, log,
///     command, pace, version
std::string to_json(const FlightSummary& summary);

/// The summary as text: at most 35 lines of at most 100 characters, if there are at most 6 regions. The explanation,
/// and the reason of an incomplete recording, are further lines after the first.
std::string to_text(const FlightSummary& summary);

inline constexpr int kExitIncomplete = 5;  ///< the vehicle reached its goal, but the recording is incomplete
/// The exit code of tern-monitor: 0 reached, 1 collision, 2 timeout, 3 failed, kExitIncomplete.
int exit_code(const FlightSummary& summary);

}  // namespace tern
