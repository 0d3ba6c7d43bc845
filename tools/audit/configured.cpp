#include "tools/audit/configured.h"

#include <algorithm>
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

std::string setting(const std::string& yaml, std::string_view path) {
  std::size_t depth = 0;  ///< of the key that is looked for
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos || indent > depth) continue;
    if (indent < depth) return "";  ///< the section has ended
    const std::string_view wanted = path.substr(0, path.find('.'));
    const std::string_view text = std::string_view(line).substr(indent);
    if (!text.starts_with(wanted) || text.substr(wanted.size()).substr(0, 1) != ":") continue;
    if (wanted.size() == path.size()) return std::string(text.substr(std::min(wanted.size() + 2, text.size())));
    path.remove_prefix(wanted.size() + 1);
    depth += 2;
  }
  return "";
}

std::string planner_setting(const FlightRecord& record, const std::string& key) {
  const ConfigurationReport* report = planners_configuration(record);
  return report == nullptr ? "" : setting(report->yaml, "planner." + key);
}

}  // namespace tern::audit
