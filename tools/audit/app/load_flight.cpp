#include "tools/audit/app/load_flight.h"

#include <charconv>
#include <filesystem>
#include <fstream>

#include "runtime/config.h"
#include "runtime/scenario_file.h"

namespace tern::audit {
namespace {

/// Returns the contents of a file in the flight's folder; empty if there is none.
std::string first_line(const std::string& log, const char* file) {
  namespace fs = std::filesystem;
  std::ifstream in((fs::is_directory(log) ? fs::path(log) : fs::path(log).parent_path()) / file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

Result<FlightRecord> load_flight(const std::string& path) {
  auto record = read_flight(path);
  if (!record) return record;
  if (record->contents.events == 0) return fail(path + ": holds no complete message");
  for (const ConfigurationReport& report : record->configurations) {
    if (report.yaml.empty()) continue;
    try {
      ConfigDocument document = ConfigDocument::parse(report.yaml, report.process);
      const SemanticsSpec semantics = read_scenario(document).semantics;
      record->regions = semantics.regions;
      record->class_labels.insert(semantics.classes.begin(), semantics.classes.end());
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
