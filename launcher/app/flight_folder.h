// The folder of one flight.
#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "launcher/flight_processes.h"

namespace tern {

/// Makes the flight's folder: the one of options.record, or a new one in options.flights. In one second several flights
/// may begin; all but the first get -2, -3 … at the end of the name. This process holds the folder until it ends, so no
/// other flight uses it. Files of a flight that failed before it began are removed.
/// @return its path, or an Error: the folder holds a flight or a log, or cannot be made or written
Result<std::filesystem::path> make_flight_folder(const LaunchOptions& options);

}  // namespace tern
