#include "mission/app/load_mission.h"

#include <filesystem>

#include "core/base/files.h"
#include "mission/check.h"
#include "mission/readers/mission_file.h"

namespace tern::mission {

Site site_of(const Scenario& scenario, const ProgressConfig& config) {
  Site site;
  site.home = scenario.uav.start;
  site.landing_height = config.landing_height_m;
  site.no_frame = "latitude and longitude need world.origin in the scenario";
  if (!scenario.world.origin) return site;
  const auto frame = LocalFrame::at(*scenario.world.origin);
  frame ? void(site.frame = *frame) : void(site.no_frame = frame.error().message);
  return site;
}

Mission load_mission(const Scenario& scenario, const MissionConfig& config) {
  if (config.file.empty()) throw ConfigError(scenario.file + ": mission.file is missing: name a mission to fly");
  const std::filesystem::path path = std::filesystem::path(scenario.file).parent_path() / config.file;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw ConfigError("mission.file: " + path.string() + ": " + error.message());
  if (size > kMaxMissionBytes) {
    throw ConfigError("mission.file: " + path.string() + " has " + std::to_string(size) + " bytes (limit " +
                      std::to_string(kMaxMissionBytes) + ")");
  }
  const Site site = site_of(scenario, config.progress);
  Mission mission = value_or_throw(parse_mission(read_text(path.string()), path.string(), site), "mission.file: ");
  for (const std::string& why : {steps_outside(mission, scenario.uav.flight_box, scenario.uav.body),
                                 steps_too_fast(mission, scenario.uav.limits)}) {
    if (!why.empty()) throw ConfigError("mission.file: " + path.string() + ": " + why);
  }
  return mission;
}

}  // namespace tern::mission
