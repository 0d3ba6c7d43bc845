// The time limit of a flight whose goals another process sends.
#pragma once

#include <string>

#include "core/scenario/scenario.h"
#include "runtime/config.h"

namespace tern {

/// Reads `simulator.goals_from`, the process that sends the goals; empty: the simulator sends the scenario's goal.
std::string read_goals_from(ConfigDocument& document);

/// Returns the scenario with the time limit that referee and monitor use. A process that sends the goals limits the
/// time of each of them. So the flight as a whole has no limit but a stated timeout_s: without it, timeout_s becomes
/// 1e6 s.
/// @param goals_from  read_goals_from()
Scenario timed(Scenario scenario, const std::string& goals_from);

}  // namespace tern
