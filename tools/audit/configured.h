// Reads single values from the CONFIGURATION messages of a log.
#pragma once

#include <string>
#include <string_view>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// Returns the value at a path such as "uav.limits.v_max", spelled as in the YAML; empty if the YAML has none.
std::string setting(const std::string& yaml, std::string_view path);

/// Returns a value of the section `planner`, empty if the log has none. The configuration whose hash the plans name
/// takes precedence, whoever published it. Otherwise tern-planner's own is read.
std::string planner_setting(const FlightRecord& record, const std::string& key);

}  // namespace tern::audit
