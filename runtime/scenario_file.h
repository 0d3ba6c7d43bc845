// Scenario files: YAML, strict, every obstacle can be written out and read back.
#pragma once

#include <string>

#include "core/world/scenario.h"
#include "runtime/config.h"

namespace tern {

/// The sections of a scenario file that belong to processes, not to the scenario itself.
inline constexpr const char* kProcessSections[] = {"simulator", "executor", "predictor", "mapper",
                                                   "planner",   "logger",   "mavlink",   "autopilot_sim"};

/// The worlds that a seed can make (WorldSpec::generator).
inline constexpr const char* kGenerators[] = {"none",          "paper_corridor", "paper_attract", "paper_repel",
                                              "corridor_demo", "mader_corridor", "sando_forest",  "step_aside"};

/// Reads name, seed, world, uav, semantics, timeout_s (scenarios/README.md lists every key); process sections are left
/// to their processes. A missing name is the file's name without folder and extension.
/// @throws ConfigError for what a key may not be, alone or together with others. The latter: start or goal (with the
/// body) outside the flight box, names given twice, a polygon that crosses itself, a region's unlisted class …
Scenario read_scenario(ConfigDocument& document);

/// The scenario as YAML with every obstacle listed; read_scenario gives the same values back (doubles round-trip).
/// @pre what read_scenario promises of its result; `file` is not written.
std::string write_scenario(const Scenario& scenario);

}  // namespace tern
