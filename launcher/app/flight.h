// One flight, from its folder to its summary.
#pragma once

#include <string>

#include "launcher/flight_processes.h"

namespace tern {

/// Flies, and looks back as it was asked to. However it ends, nobody is left, and a summary is where it was asked for.
///
/// Two processes do it. This one waits, with nothing to do that could fail, and sums up. Its child holds the keys,
/// starts the flight's processes and keeps them running; it leads a session and process group of its own. If the child
/// is killed, the kernel kills what it started, and this one whoever is left of its group. If this one is killed, the
/// kernel sends the child SIGTERM, which ends the flight in order.
/// @return the flight's exit code (exit_codes.h)
int fly(const LaunchOptions& options);

/// Writes the summary that was asked for of a flight that could not begin. @param reason  in words
void summarize_failure(const LaunchOptions& options, const std::string& reason);

}  // namespace tern
