// The data of a report as JSON, decimated: its size is bounded for a flight of any length.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/audit/audit.h"

namespace tern::report {

/// Most points along the flight. If there are more states, consecutive states share a point at the first one's place.
/// It has their greatest speed and acceleration, their least clearance and their last exposure: no extreme is lost.
inline constexpr std::size_t kMaxPathPoints = 6'000;
/// Most points of all moving obstacles together; samples are thinned evenly.
inline constexpr std::size_t kMaxMoverPoints = 60'000;
/// Most answers. If there are more, consecutive answers share a point, which shows the slowest of them.
inline constexpr std::size_t kMaxAnswers = 6'000;
/// Most runs of the map's voxels.
inline constexpr std::size_t kMaxMapRuns = 20'000;

/// Facts about a flight that its log does not contain.
struct FlightLaunch {
  std::string command = {};  ///< the command that started the flight; empty: unknown
  double pace = 1.0;         ///< of the flight's clocks, (0, 1]; the date is converted from the log's times with it
};

/// Returns the data; page/*.js reads these keys.
nlohmann::json report_data(const audit::FlightRecord& record, const audit::Audit& audit,
                           const FlightLaunch& launch = {});

/// Returns the whole page, self-contained: style, script, chart library and data.
std::string report_page(const audit::FlightRecord& record, const audit::Audit& audit, const FlightLaunch& launch = {});

}  // namespace tern::report
