#include "campaign/records/flight_record.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/world/names.h"

namespace tern {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string write(const std::string& text) { return text; }
std::string write(std::int64_t number) { return fmt::format("{}", number); }
std::string write(std::uint64_t number) { return fmt::format("{}", number); }
std::string write(double number) { return std::isnan(number) ? "" : fmt::format("{}", number); }
std::string write(FlightOutcome outcome) { return to_string(outcome); }

std::string write(const std::vector<Exposure>& exposure) {
  Json regions = Json::object();
  for (const Exposure& e : exposure) {
    regions[e.region] = {
        {"seconds", e.seconds}, {"metres", e.metres}, {"near_seconds", e.near_seconds}, {"near_metres", e.near_metres}};
  }
  return regions.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string write(const std::map<std::string, MessageCount>& messages) {
  Json channels = Json::object();
  for (const auto& [channel, count] : messages) channels[channel] = {count.received, count.rejected, count.lost};
  return channels.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string write(const Coverage& coverage) { return to_text(coverage); }

template <class Number>
bool read_number(const std::string& cell, Number& value) {
  const char* end = cell.data() + cell.size();
  const auto [rest, error] = std::from_chars(cell.data(), end, value);
  return error == std::errc{} && rest == end;
}

bool read(const std::string& cell, std::string& value) {
  value = cell;
  return true;
}
bool read(const std::string& cell, std::int64_t& value) { return read_number(cell, value); }
bool read(const std::string& cell, std::uint64_t& value) { return read_number(cell, value); }

bool read(const std::string& cell, double& value) {
  value = kNaN;
  return cell.empty() || read_number(cell, value);
}

bool read(const std::string& cell, FlightOutcome& value) {
  const auto outcome = named<FlightOutcome>(cell);
  value = outcome.value_or(value);
  return outcome.has_value();
}

bool read(const std::string& cell, std::vector<Exposure>& value) try {
  value.clear();
  const Json regions = Json::parse(cell);
  for (const auto& [region, e] : regions.items()) {
    value.push_back({region, e.at("seconds"), e.at("metres"), e.at("near_seconds"), e.at("near_metres")});
  }
  return regions.is_object();
} catch (const Json::exception&) {
  return false;
}

bool read(const std::string& cell, std::map<std::string, MessageCount>& value) try {
  value.clear();
  const Json channels = Json::parse(cell);
  for (const auto& [channel, n] : channels.items()) value[channel] = {n.at(0), n.at(1), n.at(2)};
  return channels.is_object();
} catch (const Json::exception&) {
  return false;
}

bool read(const std::string& cell, Coverage& value) {
  const auto coverage = parse_coverage(cell);
  value = coverage.value_or(Coverage{});
  return coverage.has_value();
}

struct Column {
  std::string name, meaning;
  Compared compared;
  std::function<std::string(const FlightRecord&)> write_cell;
  std::function<bool(const std::string&, FlightRecord&)> read_cell;
};

/// Makes the column of the field that a chain of member pointers leads to.
template <class... Members>
Column column(std::string name, std::string meaning, Compared compared, Members... path) {
  const auto field = [path...](auto& record) -> auto& { return (record.*....*path); };
  return {std::move(name), std::move(meaning), compared, [field](const FlightRecord& r) { return write(field(r)); },
          [field](const std::string& cell, FlightRecord& r) { return read(cell, field(r)); }};
}

template <class Array>
Column column_at(std::string name, std::string meaning, Array FlightRecord::*array, std::size_t k) {
  return {std::move(name), std::move(meaning), Compared::All,
          [array, k](const FlightRecord& r) { return write((r.*array)[k]); },
          [array, k](const std::string& cell, FlightRecord& r) { return read(cell, (r.*array)[k]); }};
}

void add_measures(std::vector<Column>& columns) {
  const auto add = [&](const char* name, const char* meaning, Compared compared, auto FlightResult::*member) {
    columns.push_back(column(name, meaning, compared, &FlightRecord::result, member));
  };
  constexpr Compared kNo = Compared::No, kReached = Compared::Reached, kAll = Compared::All;
  add("outcome", "reached, collision, timeout or failed", kNo, &FlightResult::outcome);
  add("detail", "in words: why the goal was not reached, and what would help", kNo, &FlightResult::detail);
  add("flight_time_s", "world time at arrival or end, s", kReached, &FlightResult::flight_time_s);
  add("first_entry_s", "world time of the first entry into 0.2 m about the goal, s", kReached,
      &FlightResult::first_entry_s);
  add("path_length_m", "length of the path, m", kReached, &FlightResult::path_length_m);
  add("mean_speed_mps", "straight distance / flight time, m/s", kReached, &FlightResult::mean_speed_mps);
  add("top_speed_mps", "greatest speed, m/s", kAll, &FlightResult::top_speed_mps);
  add("stops", "times below 0.1 m/s before the goal, after the first second", kAll, &FlightResult::stops);
  add("min_clearance_m", "least distance to an obstacle in continuous time, negative in overlap, m", kAll,
      &FlightResult::min_clearance_m);
  add("min_map_clearance_m",
      "least distance to an occupied voxel of the map in continuous time, negative in overlap, m", kAll,
      &FlightResult::min_map_clearance_m);
  add("jerk_integral", "integral of the squared jerk over time, m^2/s^5", kReached, &FlightResult::jerk_integral);
  add("limit_violations", "violations of speed, acceleration, jerk and flight box, and jumps", kAll,
      &FlightResult::limit_violations);
  add("contacts_moving", "contacts while faster than 0.1 m/s", kAll, &FlightResult::contacts_moving);
  add("contacts_at_rest", "contacts while slower than 0.1 m/s", kAll, &FlightResult::contacts_at_rest);
  add("obstacles", "obstacles that existed at some time of the flight", kNo, &FlightResult::obstacles);
  add("obstacles_left_out", "recorded obstacles that started too near to the vehicle", kNo,
      &FlightResult::obstacles_left_out);
}

void add_answers(std::vector<Column>& columns) {
  using R = FlightRecord;
  const auto add = [&](const char* name, const char* meaning, auto member) {
    columns.push_back(column(name, meaning, Compared::All, member));
  };
  add("requests", "plans requested", &R::requests);
  add("answered_in_time", "requests answered by their deadline", &R::answered_in_time);
  add("answers_late", "answers that were late by the executor's clock", &R::answers_late);
  add("answers_refused", "by the executor", &R::answers_refused);
  for (std::size_t k = 0; k < kPlanOutcomes; ++k) {
    const auto outcome = static_cast<PlanOutcome>(k);
    columns.push_back(column_at("plans_" + key(outcome), fmt::format("answers: {}", to_string(outcome)), &R::plans, k));
  }
  for (std::size_t k = 0; k < kPlanReasons; ++k) {
    const auto reason = static_cast<PlanReason>(k);
    columns.push_back(column_at("reasons_" + key(reason), fmt::format("answers with the reason: {}", to_string(reason)),
                                &R::reasons, k));
  }
}

void add_times(std::vector<Column>& columns) {
  struct Stage {
    const char *name, *meaning;
    Percentiles ReplanTimes::*times;
  };
  using Ranks = std::pair<const char*, double Percentiles::*>;
  for (const Stage& stage :
       {Stage{"total", "from the request's arrival to the answer", &ReplanTimes::total},
        Stage{"first_answer", "until the first certified trajectory", &ReplanTimes::first_answer},
        Stage{"hulls", "of making hulls", &ReplanTimes::hulls}, Stage{"search", "of the search", &ReplanTimes::search},
        Stage{"optimization", "of the optimizer", &ReplanTimes::optimization},
        Stage{"check", "of the final check", &ReplanTimes::check}}) {
    for (const auto& [rank, member] : {Ranks{"p50", &Percentiles::p50}, Ranks{"p95", &Percentiles::p95},
                                       Ranks{"p99", &Percentiles::p99}, Ranks{"max", &Percentiles::max}}) {
      columns.push_back(column(fmt::format("replan_ms_{}_{}", stage.name, rank),
                               fmt::format("CPU time {}, {} of the flight's answers, ms", stage.meaning, rank),
                               Compared::All, &FlightRecord::replan_ms, stage.times, member));
    }
  }
}

void add_tracking(std::vector<Column>& columns) {
  const auto add = [&](const char* name, const char* meaning, double Tracking::*member) {
    columns.push_back(column(name, meaning, Compared::Reached, &FlightRecord::tracking, member));
  };
  add("tracking_rmse_m", "by --audit: RMSE of the distance to the setpoints, m", &Tracking::rmse_m);
  add("tracking_error_m", "by --audit: greatest distance to the setpoints, m", &Tracking::error_m);
  add("tube_m", "by --audit: greatest half-width of the promised tubes, m", &Tracking::tube_m);
  add("tube_margin_m", "by --audit: least distance to a face of the tube, negative outside, m", &Tracking::margin_m);
}

std::vector<Column> make_columns() {
  using R = FlightRecord;
  constexpr Compared kNo = Compared::No;
  std::vector<Column> columns;
  columns.push_back(column("scenario", "the scenario's name", kNo, &R::identity, &CampaignIdentity::scenario));
  columns.push_back(column("seed", "seed of everything random in the flight", kNo, &R::seed));
  columns.push_back(
      column("count", "world.count: obstacles of the generator", kNo, &R::identity, &CampaignIdentity::count));
  add_measures(columns);
  add_answers(columns);
  columns.push_back(
      column("passively_safe_share",
             "share of the time certified against unseen movers, [0, 1]; empty with planner.unseen: ignore",
             Compared::All, &R::passively_safe_share));
  add_times(columns);
  columns.push_back(column("exposure", "JSON, per region: seconds and metres inside and within 1 m", kNo, &R::result,
                           &FlightResult::exposure));
  columns.push_back(column("messages", "JSON, per channel: received, rejected, lost", kNo, &R::messages));
  add_tracking(columns);
  columns.push_back(
      column("coverage",
             "JSON of --audit or --coverage, per class and time ahead: predictions, mean half-width m, covered "
             "at each confidence; claims: of plans, made and true at each",
             kNo, &R::coverage));
  columns.push_back(column("restarts", "restarts of processes in flight", kNo, &R::restarts));
  columns.push_back(
      column("audit", "passed, broken, incomplete, not judged, failed; empty: not audited", kNo, &R::audit));
  columns.push_back(column("log", "of a failed flight, relative to the failures' folder", kNo, &R::log));
  columns.push_back(
      column("charge", "cpu or counts: virtual time that planning took", kNo, &R::identity, &CampaignIdentity::charge));
  columns.push_back(column("configuration", "digest of all settings except the seed", kNo, &R::identity,
                           &CampaignIdentity::configuration));
  columns.push_back(column("version", "build", kNo, &R::identity, &CampaignIdentity::version));
  return columns;
}

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = make_columns();
  return columns;
}

}  // namespace

std::string difference(const CampaignIdentity& a, const CampaignIdentity& b) {
  std::string words;
  const auto compare = [&](const char* field, const auto& one, const auto& other) {
    if (one != other) words += fmt::format("{}{} {} against {}", words.empty() ? "" : ", ", field, one, other);
  };
  compare("scenario", a.scenario, b.scenario);
  compare("count", a.count, b.count);
  compare("charge", a.charge, b.charge);
  compare("configuration", a.configuration, b.configuration);
  compare("version", a.version, b.version);
  return words;
}

FlightResult unjudged(FlightOutcome outcome, std::string detail) {
  FlightResult result;
  result.outcome = outcome;
  result.detail = std::move(detail);
  result.flight_time_s = result.first_entry_s = result.path_length_m = kNaN;
  result.mean_speed_mps = result.top_speed_mps = result.min_clearance_m = kNaN;
  result.min_map_clearance_m = result.jerk_integral = kNaN;
  return result;
}

bool is_success(const FlightRecord& record) {
  return record.result.outcome == FlightOutcome::Reached && record.result.limit_violations == 0 &&
         (record.audit.empty() || record.audit == "passed");
}

const CsvRecord& flight_columns() {
  static const CsvRecord names = [] {
    CsvRecord made;
    for (const Column& c : all_columns()) made.push_back(c.name);
    return made;
  }();
  return names;
}

std::vector<ColumnNote> column_notes() {
  std::vector<ColumnNote> notes;
  for (const Column& c : all_columns()) notes.push_back({c.name, c.meaning, c.compared});
  return notes;
}

CsvRecord to_cells(const FlightRecord& record) {
  CsvRecord cells;
  for (const Column& c : all_columns()) cells.push_back(c.write_cell(record));
  return cells;
}

Result<FlightRecord> read_flight(const CsvRecord& cells) {
  const std::vector<Column>& columns = all_columns();
  if (cells.size() != columns.size()) return fail(fmt::format("{} cells, not {}", cells.size(), columns.size()));
  FlightRecord record;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (!columns[k].read_cell(cells[k], record)) {
      return fail(fmt::format("{}: \"{}\" cannot be read", columns[k].name, cells[k]));
    }
  }
  return record;
}

const CsvRecord& times_columns() {
  static const CsvRecord names = [] {
    CsvRecord made = {"seed", "machine", "compiler"};
    made.insert(made.end(), kMeasuredTimes.begin(), kMeasuredTimes.end());
    return made;
  }();
  return names;
}

CsvRecord to_cells(const FlightTimes& times) {
  CsvRecord cells = {write(times.seed), times.machine, times.compiler};
  for (const LogHistogram& histogram : times.times) cells.push_back(histogram.to_text());
  return cells;
}

Result<FlightTimes> read_times(const CsvRecord& cells) {
  const CsvRecord& columns = times_columns();
  if (cells.size() != columns.size()) return fail(fmt::format("{} cells, not {}", cells.size(), columns.size()));
  FlightTimes times;
  times.machine = cells[1];
  times.compiler = cells[2];
  if (!read(cells[0], times.seed)) return fail(fmt::format("seed: \"{}\" cannot be read", cells[0]));
  for (std::size_t k = 0; k < times.times.size(); ++k) {
    auto histogram = LogHistogram::parse(cells[k + 3]);
    if (!histogram) return fail(fmt::format("{}: \"{}\" cannot be read", columns[k + 3], cells[k + 3]));
    times.times[k] = std::move(*histogram);
  }
  return times;
}

}  // namespace tern
