// Scenario files: YAML, strict, every obstacle can be written out and read back.
#pragma once

#include <string>

#include "core/world/scenario.h"
#include "runtime/config.h"

namespace tern {

/// The sections of a scenario file that belong to processes, not to the scenario itself.
inline constexpr const char* kProcessSections[] = {"simulator", "executor", "predictor", "mapper", "planner", "logger"};

/// Reads name, seed, world, uav, semantics, timeout_s; process sections are left to their processes. @throws ConfigError.
Scenario read_scenario(ConfigDocument& document);

/// The scenario as YAML with every obstacle listed; read_scenario gives the same values back (doubles round-trip).
std::string write_scenario(const Scenario& scenario);

}  // namespace tern
