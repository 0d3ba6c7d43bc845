#include "tools/audit/configured.h"

#include "core/scenario/setting.h"

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

std::string planner_setting(const FlightRecord& record, const std::string& key) {
  const ConfigurationReport* report = planners_configuration(record);
  return report == nullptr ? "" : setting(report->yaml, "planner." + key);
}

}  // namespace tern::audit
