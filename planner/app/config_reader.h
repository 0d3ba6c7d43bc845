// The scenario's `planner:` section, strictly.
#pragma once

#include "core/world/scenario.h"
#include "planner/problem/planner_config.h"
#include "runtime/config.h"

namespace tern {

/// Every knob with its default and range; semantics come from the scenario. @throws ConfigError.
PlannerConfig read_planner_config(ConfigSection section, const SemanticsSpec& semantics);

}  // namespace tern
