// Reads the mission of a scenario.
#pragma once

#include "core/scenario/scenario.h"
#include "mission/app/mission_config.h"
#include "mission/mission.h"
#include "mission/step_list.h"

namespace tern::mission {

/// Returns where the scenario's missions are flown.
Site site_of(const Scenario& scenario, const ProgressConfig& config);

/// Reads the file and checks its steps against the flight box.
/// @throws ConfigError: no file is given, it is missing or refused by its reader, a step lies outside the flight box.
///   Or a step is faster than the vehicle may fly
Mission load_mission(const Scenario& scenario, const MissionConfig& config);

}  // namespace tern::mission
