// Makes the map of a scenario.
#pragma once

#include "core/scenario/scenario.h"
#include "core/world/voxel_map.h"
#include "semantic_mapper/app/cloud_report.h"
#include "semantic_mapper/app/mapper_config.h"

namespace tern {

struct LoadedMap {
  VoxelMap map;
  std::vector<MapRemark> remarks;  ///< on each point cloud, in the order of the sources, then on the map
};

/// Returns the map of the scenario's regions, the configured files and, if configured, its static obstacles.
/// With `semantics.enabled: false` only occupied voxels remain. Relative file names are searched in the scenario's
/// folder, then in data_folder().
///
/// A cloud without labels is geometry: all its points are occupied, of class "unlabelled". These are PLY, PCD and text
/// files without a class, and LAS files whose points are all of class 0 or 1. Among classified points of LAS, those of
/// class 0 and 1 are occupied as well, unless `classes` is given. A meaning that is configured for these classes has
/// priority. Occupied voxels in which the vehicle at uav.start stands are free (voxels_stood_in).
/// @param environment  value of TERN_DATA; may be null
/// @throws ConfigError with key and file: the file is missing, unreadable, refused by its reader, or has no effect
///   (report_cloud()). Also if the map would be too large.
LoadedMap load_map(const Scenario& scenario, const MapperConfig& config, const char* environment);

}  // namespace tern
