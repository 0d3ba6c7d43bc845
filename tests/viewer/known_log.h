// The known scene as a log.
#pragma once

#include <string>

#include "core/base/time.h"

namespace tern::support {

inline constexpr UTime kKnownLogStart{1'700'000'000'000'000};

/// Writes the log that tern-logger would have recorded of the whole flight.
/// @param lead  time from the begin of the log, with the first heartbeat, to world time 0
/// @param course  of the flight, rad from x to y
/// @param sighted  for so long, from the start, a camera sends its sightings ten times a second
void write_known_log(const std::string& path, Duration lead = {}, double course = 0.0, Duration sighted = {});

}  // namespace tern::support
