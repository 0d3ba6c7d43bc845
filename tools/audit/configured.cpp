#include "tools/audit/configured.h"

#include <cstdlib>
#include <sstream>

namespace tern::audit {

namespace {

const ConfigurationReport* planners_configuration(const FlightRecord& record) {
  const ConfigurationReport* own = nullptr;
  for (const ConfigurationReport& report : record.configurations) {
    if (!record.plans.empty() && report.hash == record.plans.back().inputs.configuration_hash) return &report;
    if (report.process == "tern-planner") own = &report;
  }
  return own;
}

}  // namespace

std::optional<std::string> planner_configured(const FlightRecord& record, std::string_view key) {
  const ConfigurationReport* report = planners_configuration(record);
  if (report == nullptr) return std::nullopt;
  std::optional<std::string> value;
  std::istringstream lines(report->yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos || line.compare(begin, key.size(), key) != 0) continue;
    const std::size_t colon = begin + key.size();
    if (line.compare(colon, 2, ": ") == 0) value = line.substr(colon + 2);
  }
  return value;
}

std::optional<double> planner_configured_number(const FlightRecord& record, std::string_view key) {
  const auto text = planner_configured(record, key);
  if (!text) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(text->c_str(), &end);
  if (end == text->c_str()) return std::nullopt;
  return number;
}

}  // namespace tern::audit
