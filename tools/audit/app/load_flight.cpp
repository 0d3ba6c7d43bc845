#include "tools/audit/app/load_flight.h"

#include <filesystem>
#include <fstream>

#include "runtime/config.h"
#include "runtime/scenario_file.h"

namespace tern::audit {

Result<FlightRecord> load_flight(const std::string& path) {
  auto record = read_flight(path);
  if (!record) return record;
  for (const ConfigurationReport& report : record->configurations) {
    if (report.yaml.empty()) continue;
    try {
      ConfigDocument document = ConfigDocument::parse(report.yaml, report.process);
      const SemanticsSpec semantics = read_scenario(document).semantics;
      record->regions = semantics.regions;
      record->class_labels.insert(semantics.classes.begin(), semantics.classes.end());
      break;
    } catch (const ConfigError&) {
      // Not a scenario, or one of another version: the next process's may be.
    }
  }
  return record;
}

std::string typed_command(const std::string& path) {
  namespace fs = std::filesystem;
  std::ifstream file((fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path()) / "command");
  std::string typed;
  std::getline(file, typed);
  return typed;
}

}  // namespace tern::audit
