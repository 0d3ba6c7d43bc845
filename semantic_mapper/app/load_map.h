// A scenario and its mapper section become a map: finds and reads the files.
#pragma once

#include "core/world/scenario.h"
#include "core/world/voxel_map.h"
#include "semantic_mapper/app/mapper_config.h"

namespace tern {

/// The map of the scenario's regions, the configured point clouds and, where asked for, its static obstacles. With
/// semantics off only what is occupied stays. Files are sought as given if absolute; else beside the scenario, then in
/// data_folder().
/// @param environment  TERN_DATA's value, may be null
/// @throws ConfigError that names the key and the file: not found, unreadable, refused by its reader; a map too large.
VoxelMap load_map(const Scenario& scenario, const MapperConfig& config, const char* environment);

/// No point cloud may be larger, bytes.
inline constexpr std::uintmax_t kMaxCloudBytes = 4'000'000'000;

}  // namespace tern
