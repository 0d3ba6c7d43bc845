// The section `mission:` of a scenario.
#pragma once

#include <cstdint>
#include <string>

#include "mission/progress.h"
#include "runtime/config.h"

namespace tern::mission {

struct MissionConfig {
  std::string file;  ///< as written in the scenario; "": none
  std::uint8_t system = 1;
  bool fence_uploads = false;
  bool start_on_upload = false;
  ProgressConfig progress;
};

/// Reads the section and checks that it has no further keys (docs/reference/keys.md). @throws ConfigError
MissionConfig read_mission_config(ConfigSection section);

}  // namespace tern::mission
