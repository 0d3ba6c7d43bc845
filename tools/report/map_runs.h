// The semantic map from above, run-length encoded.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/audit/flight_record.h"

namespace tern::report {

/// Encodes the newest map's voxels within 1 m of the flown heights. A column of voxels gets the first of these labels
/// that occurs in it: occupied, repulsive, attractive. Equal neighbours along x form a run [x, y, length, label] in
/// cells. Empty if there is no map, or if it needs more than `most` runs.
nlohmann::json map_runs(const audit::FlightRecord& record, std::size_t most);

}  // namespace tern::report
