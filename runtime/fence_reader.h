// Reads `world.origin` and `world.fences` of a scenario.
#pragma once

#include "core/scenario/scenario.h"
#include "runtime/config.h"

namespace tern {

/// Reads the keys `origin` and `fences` of the section `world` (docs/reference/scenarios.md).
/// @throws ConfigError: a fence needs exactly one shape, an outline must be simple, coordinates need an origin, and a
///   floor lies below its ceiling
void read_origin_and_fences(ConfigSection& world, WorldSpec& spec);

/// The most fences of a scenario or a file.
inline constexpr std::size_t kMaxFences = 1'000;

}  // namespace tern
