// Reads single values from the CONFIGURATION messages of a log.
#pragma once

#include <string>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// Returns a value of the section `planner`, empty if the log has none. The configuration whose hash the plans name
/// takes precedence, whoever published it. Otherwise tern-planner's own is read.
std::string planner_setting(const FlightRecord& record, const std::string& key);

}  // namespace tern::audit
