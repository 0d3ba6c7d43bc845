// Single values from the configurations that processes published.
#pragma once

#include <string>
#include <string_view>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A value of CONFIGURATION's YAML as it is written there, "uav.limits.v_max"; empty: it says none.
std::string setting(const std::string& yaml, std::string_view path);

/// A value of the section `planner`. It is of the configuration that plans name, whoever published it, else of
/// tern-planner's own; empty when the log has neither.
std::string planner_setting(const FlightRecord& record, const std::string& key);

}  // namespace tern::audit
