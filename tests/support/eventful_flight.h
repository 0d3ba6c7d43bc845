// A flight on virtual time, recorded as tern-logger would record it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "campaign/virtual_system.h"

namespace tern::testing {

/// A flight to be recorded, and the events during it.
struct EventfulFlight {
  std::string scenario_file;
  std::vector<std::string> overrides;
  double seconds = 3.0;  ///< from the start of all processes, virtual time
  /// Events, such as stopping or starting a process.
  std::vector<std::pair<double, std::function<void(VirtualSystem&)>>> events = {};  ///< (second, action), ascending
};

/// Records every message of every channel into a new log.
void record_virtually(const EventfulFlight& flight, const std::string& log);

}  // namespace tern::testing
