#include "campaign/recorded_flight.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/files.h"
#include "executor/app/executor_node.h"
#include "flight_log/log_writer.h"
#include "messages/codec.h"
#include "monitor/app/subscribe_flight.h"
#include "runtime/child_process.h"

namespace tern {
namespace {

/// Longest flight of any scenario, virtual time.
constexpr Duration kMaxFlight{3600LL * 1'000'000};

/// Rounds times to the microsecond, the precision of the clock.
Percentiles rounded(Percentiles p) {
  for (double* x : {&p.p50, &p.p95, &p.p99, &p.max}) *x = std::round(*x * 1e3) / 1e3;
  return p;
}

ReplanTimes rounded(const ReplanTimes& t) {
  return {rounded(t.total),  rounded(t.first_answer), rounded(t.hulls),
          rounded(t.search), rounded(t.optimization), rounded(t.check)};
}

void add(FlightTimes& times, const PlanTiming& timing) {
  const auto stage = [&](Stage s) { return timing.stage_ms[static_cast<int>(s)]; };
  times.times[0].add(timing.total_ms);
  const double parts[] = {timing.first_answer_ms, stage(Stage::BroadPhase), stage(Stage::Search),
                          stage(Stage::Optimization), stage(Stage::Check)};
  for (std::size_t k = 0; k < std::size(parts); ++k) {
    if (parts[k] > 0.0) times.times[k + 1].add(parts[k]);
  }
}

void record_text(const std::string& path, const std::string& text) {
  if (!write_text(path, text)) throw CannotRecord(path + ": cannot be written");
}

LogWriter open_recording(const std::string& path) {
  auto writer = LogWriter::open(path, 0);
  if (!writer) throw CannotRecord(writer.error().message);
  return std::move(*writer);
}

/// Passes every message to the watch, the times and the observer.
void subscribe(Bus& bus, FlightWatch& watch, FlightTimes& times, FlightObserver* observer) {
  subscribe_flight(bus, watch);
  bus.subscribe(channels::kPlanTiming, [&times](const PlanTiming& m) { add(times, m); });
  if (observer == nullptr) return;
  bus.subscribe(channels::kHorizonRequest, [observer](const HorizonRequest& m) { observer->on_request(m); });
  bus.subscribe(channels::kPlan, [observer](const Plan& m) { observer->on_plan(m); });
}

/// Runs until the watch has a verdict.
Ending fly(VirtualSystem& system, FlightWatch& watch) {
  VirtualRunner& runner = system.runner();
  const UTime end = runner.now() + kMaxFlight;
  std::optional<Ending> ending;
  const auto ended = [&] { return (ending = watch.ending(runner.now())).has_value(); };
  const RunResult run = runner.run(end, ended);
  if (ending) return *ending;
  if (run.end == RunEnd::Finished) {
    return {FlightOutcome::Failed, fmt::format("{} ended with exit code {}", run.process, run.exit_code)};
  }
  return {FlightOutcome::Failed, "no end within an hour"};
}

FlightRecord make_record(const FlightSummary& summary, const ExecutorCounters& executor, const FlightInputs& inputs,
                         const CampaignIdentity& identity) {
  FlightRecord record;
  record.identity = identity;
  record.seed = summary.seed.value_or(0);
  record.result = summary.result.value_or(unjudged(summary.outcome, summary.detail));
  record.result.outcome = summary.outcome;
  const std::string& why = summary.explanation.sentence;
  record.result.detail = why.empty() ? summary.detail : why;
  record.requests = summary.requests;
  record.answered_in_time = summary.answered_in_time;
  record.answers_late = executor.late();
  record.answers_refused = executor.refused();
  record.plans = summary.plans;
  record.reasons = summary.reasons;
  if (inputs.charge == Charge::Cpu) record.replan_ms = rounded(summary.replan_ms);
  record.messages = summary.messages;
  record.restarts = summary.restarts;
  record.passively_safe_share = summary.passively_safe_share.value_or(Tracking::kNone);
  return record;
}

/// Runs the auditor. @return "passed", "broken", "incomplete", "not judged" (tern-audit's exit codes) or "failed"
std::string run_audit(const std::string& audit, const std::string& folder) {
  const std::string output = folder + "/audit.txt";
  std::filesystem::remove(output);
  const int out = open_log(output);
  const pid_t child = start_child(
      {.command = {audit, folder + "/flight.lcm", "--json", folder + "/audit.json"}, .out = out, .error = out});
  close(out);
  const ProcessEnd end = await_child(child);
  constexpr std::array kVerdicts{"passed", "broken", "failed", "incomplete", "not judged"};
  const auto code = static_cast<std::size_t>(end.exit_code);
  return end.signal == 0 && code < kVerdicts.size() ? kVerdicts[code] : "failed";
}

/// Reads coverage and tracking from the audit. @throws std::runtime_error if its file is unreadable
void take_measures(const std::string& folder, FlightRecord& record) {
  std::ifstream file(folder + "/audit.json");
  if (!file) return;
  const auto json = nlohmann::json::parse(file, nullptr, false);
  const auto sums = json.is_object() ? json.find("coverage_sums") : json.end();
  const auto coverage =
      sums != json.end() && sums->is_string() ? parse_coverage(sums->get<std::string>()) : std::nullopt;
  if (!coverage) throw std::runtime_error(folder + "/audit.json: no coverage_sums that can be read");
  record.coverage = *coverage;
  for (const auto& check : json.value("checks", nlohmann::json::array())) {
    const auto measures = check.value("measures", nlohmann::json::object());
    const auto measure = [&](const char* name, double& value) { value = measures.value(name, value); };
    measure("tracking_rmse_m", record.tracking.rmse_m);
    measure("tracking_error_m", record.tracking.error_m);
    measure("tube_m", record.tracking.tube_m);
    measure("tube_margin_m", record.tracking.margin_m);
  }
}

void audit(const Auditor& auditor, const std::string& folder, FlightRecord& record) {
  if (auditor.program.empty()) return;
  const std::string verdict = run_audit(auditor.program, folder);
  if (auditor.judges || verdict == "failed") record.audit = verdict;
  if (verdict != "failed") take_measures(folder, record);
}

}  // namespace

RecordedFlight fly_recorded(const FlightInputs& inputs, std::uint64_t seed, const CampaignIdentity& identity,
                            const std::string& folder, const Auditor& auditor, FlightObserver* observer) {
  const std::string log = folder + "/flight.lcm";
  if (std::filesystem::exists(log)) throw CannotRecord(log + ": exists already; choose another folder");
  RecordedFlight flight;
  flight.times.seed = seed;
  flight.times.machine = machine_name();
  flight.times.compiler = compiler_name();
  std::optional<LogWriter> writer;
  {
    VirtualSystem system(inputs.scenario_file, inputs.with_seed(seed), inputs.charge);
    record_text(folder + "/scenario.yaml", spell_out(inputs, seed));
    writer.emplace(open_recording(log));  // after the inputs were accepted: a refused flight leaves no log
    VirtualRunner& runner = system.runner();
    FlightWatch watch(system.timed_scenario(), runner.now());
    runner.observer().listen([&](std::string_view channel, std::int64_t, std::span<const std::uint8_t> bytes) {
      writer->append(channel, runner.now().us, bytes);
    });
    subscribe(runner.observer(), watch, flight.times, observer);
    FlightSummary summary = watch.summary(fly(system, watch));
    summary.log = log;
    summary.version = identity.version;
    const auto estimate = watch.estimate();
    record_text(folder + "/summary.json", estimate ? with_estimate(to_json(summary), *estimate) : to_json(summary));
    flight.said = summary.said;
    flight.record = make_record(summary, system.executor().counters(), inputs, identity);
  }
  if (const auto flushed = writer->flush(); !flushed) throw CannotRecord(flushed.error().message);
  if (writer->counters().unwritten > 0) throw CannotRecord(log + ": not all messages could be written");
  audit(auditor, folder, flight.record);
  return flight;
}

std::string machine_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t at = line.find(": ");
    if (at != std::string::npos) return fmt::format("{}, {} cores", line.substr(at + 2), sysconf(_SC_NPROCESSORS_ONLN));
  }
  return fmt::format("unknown, {} cores", sysconf(_SC_NPROCESSORS_ONLN));
}

std::string compiler_name() { return TERN_COMPILER; }

}  // namespace tern
