// Collects the fences of a scenario.
#pragma once

#include <vector>

#include "core/scenario/scenario.h"
#include "semantic_mapper/app/cloud_report.h"
#include "semantic_mapper/app/mapper_config.h"

namespace tern {

/// Returns the fences of world.fences, of the files named there, and of the mission, all in W.
/// @param remarks  sentences about the fences are appended
/// @throws ConfigError
///   - for a file that is missing or refused by its reader, or a file of world.fences without a fence;
///   - for an outline that crosses itself;
///   - for latitudes without world.origin, or in a Tern that was built without GeographicLib
std::vector<Fence> load_fences(const Scenario& scenario, const MapperConfig& config, std::vector<MapRemark>& remarks);

}  // namespace tern
