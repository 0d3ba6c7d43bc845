// Single values from the configurations that processes published.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// The text behind the last line `key: text` of the planner's effective configuration, however deep it is indented. For
/// keys that occur once. It is the configuration that plans name, whoever published it, else tern-planner's own;
/// nothing when the log has neither.
std::optional<std::string> planner_configured(const FlightRecord& record, std::string_view key);
std::optional<double> planner_configured_number(const FlightRecord& record, std::string_view key);

}  // namespace tern::audit
