#include <fmt/format.h>

#include "geodesy/json_values.h"
#include "mission/readers/entry.h"
#include "mission/readers/mission_file.h"

namespace tern::mission {
namespace {

using Json = nlohmann::json;

Result<std::optional<double>> number(const Json& properties, const char* name) {
  const Json& json = member(properties, name);
  if (json.is_null()) return std::optional<double>();
  if (!json.is_number() || !std::isfinite(json.get<double>())) {
    return fail(fmt::format("{} is not a finite number", name));
  }
  return std::optional(json.get<double>());
}

/// Returns the name of a property that asks for a speed, but is not `speed`; "" if there is none. Other unknown
/// properties are for people.
std::string other_speed_among(const Json& properties) {
  if (!properties.is_object()) return "";
  for (const auto& [name, value] : properties.items()) {
    if (asks_for_other_speed(name) && !value.is_null()) return short_text(Json(name));
  }
  return "";
}

/// [longitude, latitude, height]
Result<Vec3> place(const Json& json, const Site& site) {
  if (!json.is_array() || json.size() != 3) return fail("a position is not a list of longitude, latitude and height");
  for (const Json& value : json) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return fail("a coordinate is not a finite number");
  }
  return place_of(true, json[1].get<double>(), json[0].get<double>(), json[2].get<double>(), site);
}

Result<Entry> entry_of(const Json& properties, int item) {
  if (const std::string name = other_speed_among(properties); !name.empty()) {
    return fail(fmt::format("property {} {}", name, kOtherSpeed));
  }
  Entry entry;
  entry.item = item;
  entry.name = short_text(member(properties, "name"));
  entry.action = short_text(member(properties, "action"));
  const auto hold_s = number(properties, "hold_s"), radius = number(properties, "radius_m");
  const auto speed = number(properties, "speed");
  if (!hold_s) return tl::unexpected(hold_s.error());
  if (!radius) return tl::unexpected(radius.error());
  entry.hold_s = *hold_s;
  if (!speed) return tl::unexpected(speed.error());
  entry.radius = *radius;
  entry.speed = *speed;
  if (entry.action == "follow") return fail("action follow needs an offset in x, y, z: write this mission as CSV");
  return entry;
}

Result<void> add_feature(const Json& feature, int& item, const Site& site, StepList& steps) {
  const Json& properties = member(feature, "properties");
  if (!member(properties, "fence").is_null()) return {};
  const Json& geometry = member(feature, "geometry");
  const Json& coordinates = member(geometry, "coordinates");
  const std::string type = short_text(member(geometry, "type"));
  const bool is_line = type == "LineString";
  if (!is_line && type != "Point") {
    return fail(fmt::format("geometry \"{}\" cannot be flown; a fence needs the property \"fence\"", type));
  }
  if (is_line && !coordinates.is_array()) return fail("coordinates are not a list");
  const std::size_t count = is_line ? coordinates.size() : 1;
  for (std::size_t k = 0; k < count; ++k) {
    auto entry = entry_of(properties, ++item);
    if (!entry) return tl::unexpected(entry.error());
    const auto p = place(is_line ? coordinates[k] : coordinates, site);
    if (!p) return tl::unexpected(p.error());
    entry->place = *p;
    if (const auto added = add_entry(*entry, steps); !added) return added;
  }
  return {};
}

}  // namespace

Result<std::vector<Step>> parse_geojson(std::string_view text, const Site& site) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  const Json& features = member(*json, "features");
  if (short_text(member(*json, "type")) != "FeatureCollection" || !features.is_array()) {
    return fail("is no FeatureCollection with features");
  }
  StepList steps(site);
  int item = 0;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (const auto added = add_feature(features[k], item, site, steps); !added) {
      return fail(fmt::format("features[{}]: {}", k, added.error().message));
    }
  }
  return steps.take();
}

}  // namespace tern::mission
