#include <fmt/format.h>

#include "geodesy/json_values.h"
#include "mission/readers/mission_file.h"

namespace tern::mission {
namespace {

using Json = nlohmann::json;

/// Returns a whole number in [0, 65535], or an Error with its name.
Result<int> whole(const Json& json, const std::string& name) {
  if (!json.is_number()) return fail(fmt::format("{} is missing or not a number", name));
  const double value = json.get<double>();
  if (!(value >= 0.0 && value <= 65'535.0) || value != std::floor(value)) {
    return fail(fmt::format("{} = {} is not a whole number from 0 to 65535", name, value));
  }
  return static_cast<int>(value);
}

Result<Item> read_item(const Json& json, int place) {
  const std::string at = fmt::format("mission.items[{}]", place);
  if (const std::string type = short_text(member(json, "type")); type != "SimpleItem") {
    const std::string kind = short_text(member(json, "complexItemType"));
    return fail(fmt::format("{}: type \"{}\"{} cannot be flown; convert it to single waypoints", at, type,
                            kind.empty() ? "" : " (" + kind + ")"));
  }
  Item item;
  const auto command = whole(member(json, "command"), at + ".command");
  const auto frame = whole(member(json, "frame"), at + ".frame");
  if (!command) return tl::unexpected(command.error());
  if (!frame) return tl::unexpected(frame.error());
  item.command = *command;
  item.frame = *frame;
  item.number = place + 1;
  if (const Json& number = member(json, "doJumpId"); !number.is_null()) {
    const auto read = whole(number, at + ".doJumpId");
    if (!read) return tl::unexpected(read.error());
    item.number = *read;
  }
  if (const Json& goes_on = member(json, "autoContinue"); !goes_on.is_null()) {
    if (!goes_on.is_boolean()) return fail(at + ".autoContinue is neither true nor false");
    item.goes_on = goes_on.get<bool>();
  }
  const Json& params = member(json, "params");
  if (!params.is_array() || params.size() != 7) return fail(at + ".params is not a list of 7 numbers");
  double* const values[] = {&item.params[0], &item.params[1], &item.params[2], &item.params[3],
                            &item.x,         &item.y,         &item.z};
  for (std::size_t k = 0; k < 7; ++k) {
    if (params[k].is_null()) continue;  // not given
    if (!params[k].is_number() || !std::isfinite(params[k].get<double>())) {
      return fail(fmt::format("{}.params[{}] is neither a finite number nor null", at, k));
    }
    *values[k] = params[k].get<double>();
  }
  return item;
}

}  // namespace

Result<std::vector<Item>> parse_plan(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return tl::unexpected(json.error());
  if (short_text(member(*json, "fileType")) != "Plan") return fail("fileType is not \"Plan\"");
  const Json& version = member(*json, "version");
  if (!version.is_number() || version.get<double>() != 1.0) return fail("version is not 1, the only one that is known");
  if (!member(member(*json, "geoFence"), "breachReturn").is_null()) {
    return fail("has a breach return point, which cannot be flown to: the vehicle stays inside its fences; remove it");
  }
  const Json& rally_points = member(member(*json, "rallyPoints"), "points");
  if (rally_points.is_array() && !rally_points.empty()) {
    return fail(fmt::format("has {} rally points, which cannot be flown to: a return leads to uav.start; remove them",
                            rally_points.size()));
  }
  const Json& items = member(member(*json, "mission"), "items");
  if (!items.is_array()) return fail("has no list mission.items");
  if (items.size() > static_cast<std::size_t>(kMaxSteps)) {
    return fail(fmt::format("has {} items (limit {})", items.size(), kMaxSteps));
  }
  std::vector<Item> read;
  for (std::size_t k = 0; k < items.size(); ++k) {
    const auto item = read_item(items[k], static_cast<int>(k));
    if (!item) return tl::unexpected(item.error());
    read.push_back(*item);
  }
  return read;
}

}  // namespace tern::mission
