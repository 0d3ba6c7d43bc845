// A recorded flight with the regions that its processes' configurations draw.
#pragma once

#include <string>

#include "tools/audit/flight_record.h"

namespace tern::audit {

/// read_flight(), and the scenario's regions from a CONFIGURATION in the log (every process publishes the scenario).
Result<FlightRecord> load_flight(const std::string& path);

}  // namespace tern::audit
