// Reads the scenario's `planner:` section.
#pragma once

#include "core/scenario/scenario.h"
#include "planner/problem/planner_config.h"
#include "runtime/config.h"

namespace tern {

/// Reads every key of PlannerConfig; semantics come from the scenario's `semantics:`.
/// @throws ConfigError for an unknown key, a wrong type, or a value out of range; also if a method needs Ipopt and it
///   cannot be loaded
PlannerConfig read_planner_config(ConfigSection section, const SemanticsSpec& semantics);

}  // namespace tern
