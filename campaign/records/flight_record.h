// One flight's row in FLIGHTS.csv, and its row of measured answer times.
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

/// The properties that all flights of a campaign share. Flights of different identities are kept in different files.
struct CampaignIdentity {
  std::string scenario;       ///< its name
  std::int64_t count = 0;     ///< obstacles of the world's generator
  std::string charge;         ///< "cpu" or "counts"
  std::string configuration;  ///< 16 hex digits: the digest of the effective configuration with seed 0
  std::string version;        ///< build id

  friend bool operator==(const CampaignIdentity&, const CampaignIdentity&) = default;
};

/// Returns the differing fields as text: `scenario "a" against "b"`; "" if all are equal.
std::string difference(const CampaignIdentity& a, const CampaignIdentity& b);

/// Tracking errors by the audit; NaN without an audit.
struct Tracking {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double rmse_m = kNone, error_m = kNone;  ///< RMSE and maximum of the distance to the setpoints
  double tube_m = kNone;                   ///< greatest half-width of the promised tubes
  double margin_m = kNone;                 ///< least distance to a face of the tube; negative outside
};

/// The results of one flight.
struct FlightRecord {
  CampaignIdentity identity;
  std::uint64_t seed = 0;
  FlightResult result;  ///< outcome and detail are always set; without a referee, measures are NaN and counts 0
  std::int64_t requests = 0, answered_in_time = 0;
  std::int64_t answers_late = 0, answers_refused = 0;  ///< by the executor
  std::array<std::int64_t, kPlanOutcomes> plans = {};
  std::array<std::int64_t, kPlanReasons> reasons = {};
  ReplanTimes replan_ms;  ///< NaN if times are not charged, since they would differ from run to run
  std::map<std::string, MessageCount> messages;
  std::int64_t restarts = 0;
  double passively_safe_share = Tracking::kNone;  ///< FlightSummary::passively_safe_share; NaN: not known
  Tracking tracking;
  Coverage coverage;  ///< of predictions, by the audit; empty without an audit
  std::string audit;  ///< "passed", "broken", "incomplete", "not judged", "failed"; "" without an audit
  std::string log;    ///< of a failed flight, relative to the folder of failures
};

/// Returns the result of a flight without a referee; all measures are NaN.
FlightResult unjudged(FlightOutcome outcome, std::string detail);

/// Returns true if the goal was reached, within all limits, and the audit did not find a violation.
bool is_success(const FlightRecord& record);

/// Returns the names of the columns, in order: the keys of fly.sh's summary, nested ones joined by '_'.
const CsvRecord& flight_columns();

/// Which pairs of flights with one seed a column is compared over.
enum class Compared {
  No,       ///< not a measure
  Reached,  ///< pairs in which both reached the goal
  All,
};
/// The description of a column.
struct ColumnNote {
  std::string name, meaning;  ///< the meaning includes the unit
  Compared compared = Compared::No;
};
/// Returns the dictionary of the columns, in order.
std::vector<ColumnNote> column_notes();

/// Returns one cell per column; unknown values are empty cells. Reading restores equal values, except times, which are
/// rounded to 1 µs.
CsvRecord to_cells(const FlightRecord& record);
/// Reads a row. @return an Error that names column and cell
Result<FlightRecord> read_flight(const CsvRecord& cells);

/// The times that PLAN_TIMING measures of each answer.
inline constexpr std::array kMeasuredTimes = {"replan_ms", "first_answer_ms", "hulls_ms",
                                              "search_ms", "optimization_ms", "check_ms"};

/// The answer times of one flight, in a form that can be merged. A stage counts only the answers in which it ran.
struct FlightTimes {
  std::uint64_t seed = 0;
  std::string machine;   ///< machine of the measurement
  std::string compiler;  ///< compiler of the program
  std::array<LogHistogram, kMeasuredTimes.size()> times;
};

const CsvRecord& times_columns();
CsvRecord to_cells(const FlightTimes& times);
Result<FlightTimes> read_times(const CsvRecord& cells);

}  // namespace tern
