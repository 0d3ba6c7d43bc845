#include "mission/app/mission_config.h"

namespace tern::mission {

MissionConfig read_mission_config(ConfigSection section) {
  MissionConfig config;
  config.file = section.text("file", config.file,
                             "the mission: .plan, .csv or .geojson; absolute, or relative to the scenario's folder");
  config.system = static_cast<std::uint8_t>(
      section.integer("system", config.system, 1, 255,
                      "MAVLink system id of the vehicle, for the ground station that uploads missions"));
  section.read(config.progress);
  return config;
}

}  // namespace tern::mission
