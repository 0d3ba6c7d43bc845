// Makes the map of a scenario; finds and reads the point cloud files.
#pragma once

#include "core/world/scenario.h"
#include "core/world/voxel_map.h"
#include "semantic_mapper/app/mapper_config.h"

namespace tern {

/// Returns the map of the scenario's regions, the configured point clouds and, if configured, its static obstacles.
/// With `semantics.enabled: false` only occupied voxels remain. Relative file names are searched in the scenario's
/// folder, then in data_folder().
/// @param environment  value of TERN_DATA; may be null
/// @throws ConfigError with key and file, if a file is missing, unreadable or refused by its reader, or if the map
///   would be too large
VoxelMap load_map(const Scenario& scenario, const MapperConfig& config, const char* environment);

/// The largest point cloud file, bytes.
inline constexpr std::uintmax_t kMaxCloudBytes = 4'000'000'000;

}  // namespace tern
