// One flight, from its folder to its summary.
#pragma once

#include <string>

#include "launcher/flight_processes.h"

namespace tern {

/// Flies, then runs the audit and the report if requested. However the flight ends, no process is left behind, and the
/// summary is written where it was requested. If that cannot be done, it is reported on standard error, and exit code 0
/// becomes 5.
///
/// Two processes share the work:
/// - This process waits and sums up. It has little to do, so that little can fail.
/// - Its child holds the keys, starts the flight's processes and restarts them. It leads a session and a process group.
///
/// If the child is killed, the kernel kills the processes that it started, and this process kills the rest of its
/// group. If this process is killed, the kernel sends SIGTERM to the child, which ends the flight in order.
/// @return the flight's exit code (docs/reference/exit_codes.md)
/// @throws std::runtime_error before the flight, if its folder or the summary's file cannot be written
int fly(const LaunchOptions& options);

/// Writes the requested summary of a flight that could not begin. @param reason  in words
void summarize_failure(const LaunchOptions& options, const std::string& reason);

}  // namespace tern
