// Lists the messages of a log that its readers did not get.
#pragma once

#include <string>

#include "flight_log/flight_log.h"

namespace tern::exporting {

/// Returns a line per channel and reason: not Tern's, refused, lost; and a line for each kind of damage. Empty if there
/// is nothing.
std::string shortfalls(const LogContents& contents);

}  // namespace tern::exporting
