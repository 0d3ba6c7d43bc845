#include "tools/audit/app/load_flight.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/files.h"
#include "core/scenario/obstacle_names.h"
#include "monitor/app/subscribe_flight.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "runtime/timed_scenario.h"

namespace tern::audit {
namespace {

namespace fs = std::filesystem;

/// Returns the path of a file in the flight's folder.
fs::path beside(const std::string& log, const char* file) {
  return (fs::is_directory(log) ? fs::path(log) : fs::path(log).parent_path()) / file;
}

/// Returns the first line of a file in the flight's folder; empty if there is none.
std::string first_line(const std::string& log, const char* file) {
  std::ifstream in(beside(log, file));
  std::string line;
  std::getline(in, line);
  return line;
}

/// The flight's length by the summary beside the log, if it is the summary of this log.
std::optional<double> summary_flight_s(const std::string& log) {
  const auto summary = nlohmann::json::parse(read_text(beside(log, "summary.json")), nullptr, false);
  if (!summary.is_object() || !summary.contains("flight_time_s") || !summary["flight_time_s"].is_number()) return {};
  const std::string recorded =
      fs::path(summary.value("log", nlohmann::json()).is_string() ? summary["log"].get<std::string>() : "").filename();
  return recorded == fs::path(log).filename() || fs::is_directory(log)
             ? std::optional(summary["flight_time_s"].get<double>())
             : std::nullopt;
}

/// Returns the process that sent the goals, by a configuration; empty: the simulator.
/// @throws ConfigError for a configuration that cannot be read
std::string goals_from(const FlightRecord& record) {
  for (const ConfigurationReport& report : record.configurations) {
    ConfigDocument document = ConfigDocument::parse(report.yaml, report.process);
    if (std::string process = read_goals_from(document); !process.empty()) return process;
  }
  return "";
}

/// Explains the flight's end as tern-monitor did, by the same messages.
std::string why(const FlightRecord& record, const Scenario& scenario) {
  FlightWatch watch(scenario, UTime{record.contents.first_us});
  FlightLog log;
  const auto pass = [&]<class T>(const Channel<T>& channel) {
    log.on(channel, [&watch](const T& message, std::int64_t received_us) {
      if constexpr (requires { watch.receive(message, UTime{}); }) {
        watch.receive(message, UTime{received_us});
      } else {
        watch.receive(message);
      }
    });
  };
  for_each_channel(pass, kJudgedChannels);
  if (!log.read(record.path)) return "";
  if (fs::exists(beside(record.path, "env.sh"))) watch.set_pace(flown_pace(record.path));
  if (const std::string failure = first_line(record.path, "failure"); !failure.empty()) watch.fail(failure);
  const auto ending = watch.ending(UTime{record.contents.last_us} + kLastReports);
  return ending ? watch.summary(*ending).explanation.sentence : "";
}

}  // namespace

Result<FlightRecord> load_flight(const std::string& path) {
  auto record = read_flight(path);
  if (!record) return record;
  if (record->contents.events == 0) return fail(path + ": holds no complete message");
  record->summary_flight_s = summary_flight_s(path);
  for (const ConfigurationReport& report : record->configurations) {
    for (auto& [id, name] : obstacle_names(report.yaml)) record->obstacle_names[id] = name;
  }
  for (const ConfigurationReport& report : record->configurations) {
    if (report.yaml.empty()) continue;
    try {
      ConfigDocument document = ConfigDocument::parse(report.yaml, report.process);
      const Scenario scenario = read_scenario(document);
      const SemanticsSpec& semantics = scenario.semantics;
      record->regions = semantics.regions;
      record->class_labels.insert(semantics.classes.begin(), semantics.classes.end());
      record->why = why(*record, timed(scenario, goals_from(*record)));
      break;
    } catch (const ConfigError&) {
      // It is no scenario, or one of another version; the next process's may be readable.
    }
  }
  return record;
}

std::string typed_command(const std::string& path) { return first_line(path, "command"); }

double flown_pace(const std::string& path) {
  const std::string line = first_line(path, "env.sh"), name = "TERN_PACE=";
  const std::size_t at = line.find(name);
  if (at == std::string::npos) return 1.0;
  double pace = 0.0;
  const std::from_chars_result read = std::from_chars(line.data() + at + name.size(), line.data() + line.size(), pace);
  return read.ec == std::errc{} && pace > 0.0 && pace <= 1.0 ? pace : 1.0;
}

}  // namespace tern::audit
