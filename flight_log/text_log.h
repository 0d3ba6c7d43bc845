// A log as text, with one line per message, for fixtures in the source tree.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "flight_log/log_format.h"

namespace tern {

/// The first line of a text log. Other lines that begin with '#' are comments.
inline constexpr std::string_view kTextLogHead = "# tern text log 1";

/// Returns an event as a line: "CHANNEL µs hexadecimal-data".
std::string text_line(const LogEvent& event);

/// Returns the event of a line, or nullopt if the line has another form.
std::optional<LogEvent> event_of_line(std::string_view line);

/// True if the file begins with kTextLogHead.
bool is_text_log(const std::string& path);

/// Calls `use` for each event, in the file's order; numbers start at 0.
/// @return an Error that names file and line if a line is neither an event nor a comment
Result<void> read_text_log(const std::string& path, const std::function<void(const LogEvent&)>& use);

}  // namespace tern
