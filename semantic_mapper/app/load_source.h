// Finds and reads the files of a map: point clouds and OctoMaps.
#pragma once

#include <vector>

#include "core/scenario/scenario.h"
#include "semantic_mapper/app/cloud_report.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {

/// Reads a point cloud and gives its classes their meanings (load_map()).
/// @param environment  value of TERN_DATA; may be null
/// @param remarks  sentences about the source are appended
/// @throws ConfigError with key and file: the file is missing, unreadable, refused by its reader, or has no effect
CloudLayer load_cloud(const CloudSource& source, const Scenario& scenario, const MapperConfig& config,
                      const char* environment, std::vector<MapRemark>& remarks);

/// The same for an OctoMap. @pre source.format is OctoMap
OctoMapFile load_octomap(const CloudSource& source, const Scenario& scenario, const MapperConfig& config,
                         const char* environment, std::vector<MapRemark>& remarks);

/// Sets the meanings of the classes that are named. A class named itself overrules its group.
void set_meanings(const std::vector<std::pair<std::string, VoxelLabel>>& named, ClassMeanings& classes);

/// Returns whether voxels of this label are in a map: without semantics, attractive and repulsive ones are not.
inline bool is_kept(VoxelLabel label, bool semantics) {
  return semantics || (label != VoxelLabel::Attractive && label != VoxelLabel::Repulsive);
}

/// The largest file, bytes.
inline constexpr std::uintmax_t kMaxCloudBytes = 4'000'000'000;

}  // namespace tern
