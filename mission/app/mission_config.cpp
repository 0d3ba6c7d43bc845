#include "mission/app/mission_config.h"

namespace tern::mission {

MissionConfig read_mission_config(ConfigSection section) {
  MissionConfig config;
  config.file = section.text("file", config.file,
                             "the mission: .plan, .csv or .geojson; absolute, or relative to the scenario's folder");
  config.system = static_cast<std::uint8_t>(
      section.integer("system", config.system, 1, 255,
                      "MAVLink system id of the vehicle, for the ground station that uploads missions"));
  config.fence_uploads = section.flag("fence_uploads", config.fence_uploads,
                                      "a ground station may upload fences: tern-mapper publishes no map before it has "
                                      "heard FENCES of tern-mission");
  config.start_on_upload = section.flag("start_on_upload", config.start_on_upload,
                                        "an uploaded mission begins without an order, 3 s after the last upload and "
                                        "once its fences are in force");
  section.read(config.progress);
  return config;
}

}  // namespace tern::mission
