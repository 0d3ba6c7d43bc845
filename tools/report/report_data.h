// What a report shows of a flight, as JSON: decimated so that it stays small however long the flight was.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/audit/audit.h"

namespace tern::report {

/// At most so many points along the flight. Beyond that, successive states share a point, which is where the first of
/// them is. It has their greatest speed and acceleration, least clearance and last exposure, so that no extreme is
/// hidden.
inline constexpr std::size_t kMaxPathPoints = 6'000;
/// At most so many points of all moving obstacles together, each obstacle's samples evenly thinned.
inline constexpr std::size_t kMaxMoverPoints = 60'000;
/// At most so many answers; beyond that, successive ones share a point: the slowest of them.
inline constexpr std::size_t kMaxAnswers = 6'000;
/// At most so many runs of the map's voxels.
inline constexpr std::size_t kMaxMapRuns = 20'000;

/// What a log does not tell of its flight.
struct FlightLaunch {
  std::string command = {};  ///< what was typed to fly; empty: not known
  double pace = 1.0;         ///< of the flight's clocks, (0, 1]: the log's times are theirs, the date is not
};

/// The keys are those that page/*.js read.
nlohmann::json report_data(const audit::FlightRecord& record, const audit::Audit& audit,
                           const FlightLaunch& launch = {});

/// The whole page, self-contained: style, script, charts' library and data within.
std::string report_page(const audit::FlightRecord& record, const audit::Audit& audit, const FlightLaunch& launch = {});

}  // namespace tern::report
