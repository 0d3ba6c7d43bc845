// Scenario files: strict YAML; every scenario can be written out and read back.
#pragma once

#include <string>

#include "core/scenario/scenario.h"
#include "runtime/config.h"

namespace tern {

/// Sections of a scenario file that belong to processes.
inline constexpr const char* kProcessSections[] = {"simulator", "executor", "predictor", "mapper",  "planner",
                                                   "logger",    "detector", "estimator", "mavlink", "autopilot_sim",
                                                   "mission",   "dimos",    "features"};

/// Generators of worlds (WorldSpec::generator).
inline constexpr const char* kGenerators[] = {"none",         "paper_corridor", "paper_attract",
                                              "paper_repel",  "corridor_demo",  "mader_corridor",
                                              "sando_forest", "step_aside",     "blind_corner"};

/// Reads name, seed, world, uav, semantics and timeout_s (docs/reference/scenarios.md lists every key). The processes
/// read their own sections. A missing name is the file's name without folder and extension.
/// @throws ConfigError for a value that is not allowed, alone or together with others. Examples of the latter: start or
///   goal (with the body) outside the flight box; a name given twice; a polygon that crosses itself. A region's class
///   must be listed.
Scenario read_scenario(ConfigDocument& document);

/// The scenario as YAML with every obstacle listed. read_scenario returns the same values (doubles round-trip).
/// @pre `scenario` satisfies all rules of read_scenario. `file` is not written.
std::string write_scenario(const Scenario& scenario);

}  // namespace tern
