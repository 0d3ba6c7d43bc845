// Loads a recorded flight with its scenario's regions, and the facts that stand beside the log.
#pragma once

#include <string>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// read_flight(), and the scenario's regions from any CONFIGURATION in the log: every process publishes the scenario.
Result<FlightRecord> load_flight(const std::string& path);

/// The command that started the flight, from the flight's folder beside the log; empty if that folder has none.
std::string typed_command(const std::string& path);

/// The pace of the flight's clocks, in (0, 1], from the flight's folder beside the log; 1 if that folder has none.
double flown_pace(const std::string& path);

}  // namespace tern::audit
