// A log as text, for fixtures that live beside a test's source: a line per message.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "flight_log/log_format.h"

namespace tern {

/// The first line of a text log. Further lines that begin with '#' are for people.
inline constexpr std::string_view kTextLogHead = "# tern text log 1";

/// "CHANNEL µs hexadecimal-data"
std::string text_line(const LogEvent& event);

/// @return the event of a line, or nullopt if it is none.
std::optional<LogEvent> event_of_line(std::string_view line);

/// Whether a file begins with kTextLogHead.
bool is_text_log(const std::string& path);

/// Calls `use` for each event, in the file's order, numbered from 0.
/// @return an Error that names file and line of what is neither an event nor a comment.
Result<void> read_text_log(const std::string& path, const std::function<void(const LogEvent&)>& use);

}  // namespace tern
