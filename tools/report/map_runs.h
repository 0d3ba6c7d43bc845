// The semantic map as seen from above, in runs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/audit/flight_record.h"

namespace tern::report {

/// Of the newest map, the voxels within a metre of the heights that were flown. A column is the first of occupied,
/// repulsive, attractive that occurs there; columns come along x in runs [x, y, length, label] in cells. Empty when
/// there is no map, or when it takes more than `most` runs.
nlohmann::json map_runs(const audit::FlightRecord& record, std::size_t most);

}  // namespace tern::report
