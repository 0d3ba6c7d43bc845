// What a campaign keeps of one flight: a line of FLIGHTS.csv, and a line of what was measured of its answers.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "campaign/records/csv.h"
#include "campaign/statistics/coverage.h"
#include "campaign/statistics/log_histogram.h"
#include "core/base/result.h"
#include "core/world/flight_result.h"
#include "core/world/horizon.h"
#include "monitor/flight_summary.h"

namespace tern {

/// What all flights of a campaign have in common. Flights of different identities are not put into one file.
struct CampaignIdentity {
  std::string scenario;       ///< its name
  std::int64_t count = 0;     ///< obstacles of the world's generator
  std::string charge;         ///< "cpu" or "counts"
  std::string configuration;  ///< 16 hex digits: the digest of the effective configuration with seed 0
  std::string version;        ///< build id

  friend bool operator==(const CampaignIdentity&, const CampaignIdentity&) = default;
};

/// The fields in which they differ, as text: `scenario "a" against "b"`; "" when they are equal.
std::string difference(const CampaignIdentity& a, const CampaignIdentity& b);

/// How the vehicle followed its setpoints, by the audit; NaN when none was asked for.
struct Tracking {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double rmse_m = kNone, error_m = kNone;  ///< of its distance to them: RMSE and greatest
  double tube_m = kNone;                   ///< greatest half-width of the tubes that were promised
  double margin_m = kNone;                 ///< least distance that was left to a tube's face, negative outside
};

struct FlightRecord {
  CampaignIdentity identity;
  std::uint64_t seed = 0;
  FlightResult result;  ///< outcome and detail always; a measure that no referee gave is NaN (counts: 0)
  std::int64_t requests = 0, answered_in_time = 0;
  std::int64_t answers_late = 0, answers_refused = 0;  ///< by the executor
  std::array<std::int64_t, kPlanOutcomes> plans = {};
  std::array<std::int64_t, kPlanReasons> reasons = {};
  ReplanTimes replan_ms;  ///< NaN where times are not charged: they would differ from run to run
  std::map<std::string, MessageCount> messages;
  std::int64_t restarts = 0;
  Tracking tracking;
  Coverage coverage;  ///< of predictions, by the audit; nothing when none was asked for
  std::string audit;  ///< "passed", "broken", "failed"; "" when none was asked for
  std::string log;    ///< of a failed flight: its log, relative to the campaign's failures
};

/// A flight that nobody judged, with NaN for all measures.
FlightResult unjudged(FlightOutcome outcome, std::string detail);

/// Reached, within all limits, and kept by the audit.
bool is_success(const FlightRecord& record);

/// The names of the columns, in order: the keys of fly.sh's summary, nested ones joined by '_'.
const CsvRecord& flight_columns();

/// Over which pairs of flights of one seed a column's numbers are compared.
enum class Compared {
  No,       ///< not a measure
  Reached,  ///< pairs in which both reached the goal
  All,
};
struct ColumnNote {
  std::string name, meaning;  ///< with the unit
  Compared compared = Compared::No;
};
/// The dictionary of the columns, in order.
std::vector<ColumnNote> column_notes();

/// One cell per column. What has no value is empty. Reads back equal, but for times: they are kept to the microsecond.
CsvRecord to_cells(const FlightRecord& record);
/// @return an Error that names column and cell.
Result<FlightRecord> read_flight(const CsvRecord& cells);

/// What PLAN_TIMING measures of each answer.
inline constexpr std::array kMeasuredTimes = {"replan_ms", "first_answer_ms", "hulls_ms",
                                              "search_ms", "optimization_ms", "check_ms"};

/// All of a flight's answers, in a form that can be merged. A stage counts the answers in which it ran.
struct FlightTimes {
  std::uint64_t seed = 0;
  std::string machine;   ///< on which they were measured
  std::string compiler;  ///< of the program
  std::array<LogHistogram, kMeasuredTimes.size()> times;
};

const CsvRecord& times_columns();
CsvRecord to_cells(const FlightTimes& times);
Result<FlightTimes> read_times(const CsvRecord& cells);

}  // namespace tern
