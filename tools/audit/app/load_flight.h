// A recorded flight with the regions that its processes' configurations draw.
#pragma once

#include <string>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// read_flight(), and the scenario's regions from a CONFIGURATION in the log (every process publishes the scenario).
Result<FlightRecord> load_flight(const std::string& path);

/// What was typed to fly, as the folder of a flight keeps it beside the log; empty: not known.
std::string typed_command(const std::string& path);

/// The pace of the flight's clocks, (0, 1], as the folder of a flight keeps it beside the log; 1 where it says none.
double flown_pace(const std::string& path);

}  // namespace tern::audit
