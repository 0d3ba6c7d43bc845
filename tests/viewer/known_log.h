// The known scene as a log.
#pragma once

#include <string>

#include "core/base/time.h"

namespace tern::support {

inline constexpr UTime kKnownLogStart{1'700'000'000'000'000};

/// Writes the whole flight as tern-logger would have recorded it.
/// @param lead  so long before world time 0 a process is heard first, and the log begins
/// @param course  of the flight, rad from x to y
void write_known_log(const std::string& path, Duration lead = {}, double course = 0.0);

}  // namespace tern::support
