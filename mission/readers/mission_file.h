// Reads a mission from a file: a plan of QGroundControl, CSV or GeoJSON.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "mission/items.h"
#include "mission/mission.h"

namespace tern::mission {

/// Reads the mission of a file by the ending of its name: .plan, .csv, .geojson or .json. Files may be hostile; an
/// Error names `file`, item or line, value and limit. O(bytes).
Result<Mission> parse_mission(std::string_view text, const std::string& file, const Site& site);

/// A plan of QGroundControl ("Plan File Format", version 1): the items of its section `mission`. Its fences are read by
/// the mapper. Complex items (surveys) are refused by their names.
Result<std::vector<Item>> parse_plan(std::string_view text);

/// One waypoint per line; the first line names the columns, in any order, separated by commas:
///
/// | column | meaning | without it |
/// |---|---|---|
/// | x, y, z | position in W, m | latitude, longitude and height are needed |
/// | latitude, longitude, height | degrees, m above the origin | x, y, z are needed |
/// | action | pass, stop, land, return, follow | stop if hold_s > 0, else pass |
/// | hold_s | how long the vehicle stays, s | 0 |
/// | radius_m | of pass, m | the configured radius |
/// | speed | largest speed on the way there, m/s | that of the vehicle |
/// | track | id of the track to follow | 0 |
/// | name | for people | waypoint and line |
///
/// Lines that begin with # are skipped. Numbers of columns without a meaning for the action must be empty.
Result<std::vector<Step>> parse_csv(std::string_view text, const Site& site);

/// GeoJSON (RFC 7946): Points, and the corners of LineStrings, in the order of the file; [longitude, latitude, height].
/// Properties action, hold_s, radius_m, speed and name are those of CSV. Features with a property `fence` are skipped:
/// the mapper reads them. Other geometries are refused.
Result<std::vector<Step>> parse_geojson(std::string_view text, const Site& site);

/// The largest file, bytes.
inline constexpr std::size_t kMaxMissionBytes = 4'000'000;

}  // namespace tern::mission
