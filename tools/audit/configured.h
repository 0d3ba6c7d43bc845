// Single values from the configurations that processes published.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// The text behind the last line `key: text` of a process's effective configuration, however deep it is indented. For
/// keys that occur once; nothing when the process published none.
std::optional<std::string> configured(const FlightRecord& record, std::string_view process, std::string_view key);
std::optional<double> configured_number(const FlightRecord& record, std::string_view process, std::string_view key);

}  // namespace tern::audit
