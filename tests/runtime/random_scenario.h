// Scenarios that use every key, and their comparison field by field.
#pragma once

#include <string>

#include "core/base/random.h"
#include "core/scenario/scenario.h"

namespace tern {

/// A scenario that keeps read_scenario's rules: every motion, shape and option comes up over seeds; numbers have full
/// mantissas.
Scenario random_scenario(Rng& rng);

/// The first field that differs ("uav.start"), or "" if the scenarios are equal but for `file`.
std::string difference(const Scenario& a, const Scenario& b);

}  // namespace tern
