#include "mission/readers/mission_file.h"

#include <fmt/format.h>

#include <utility>

namespace tern::mission {
namespace {

Result<std::vector<Step>> parse_steps(std::string_view text, const std::string& file, const Site& site) {
  const auto ends_with = [&](const char* ending) { return file.ends_with(ending); };
  if (ends_with(".csv")) return parse_csv(text, site);
  if (ends_with(".geojson") || ends_with(".json")) return parse_geojson(text, site);
  if (!ends_with(".plan")) return fail("its name must end in .plan, .csv, .geojson or .json");
  const auto items = parse_plan(text);
  if (!items) return tl::unexpected(items.error());
  return steps_of(*items, site);
}

}  // namespace

Result<Mission> parse_mission(std::string_view text, const std::string& file, const Site& site) {
  if (text.size() > kMaxMissionBytes) {
    return fail(fmt::format("{}: has {} bytes (limit {})", file, text.size(), kMaxMissionBytes));
  }
  auto steps = parse_steps(text, file, site);
  if (!steps) return fail(fmt::format("{}: {}", file, steps.error().message));
  return Mission{file, std::move(*steps)};
}

}  // namespace tern::mission
