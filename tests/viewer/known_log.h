// The known scene as a log.
#pragma once

#include <string>

#include "core/base/time.h"

namespace tern::support {

inline constexpr UTime kKnownLogStart{1'700'000'000'000'000};

/// Writes the whole flight as tern-logger would have recorded it.
void write_known_log(const std::string& path);

}  // namespace tern::support
