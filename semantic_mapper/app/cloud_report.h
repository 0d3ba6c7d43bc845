// Reports what a map uses of a file, and refuses a file without effect.
#pragma once

#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {

/// A sentence for the user about one source.
struct MapRemark {
  std::string text;
  bool is_warning = false;
};

/// Returns one line on the points that are used, and a warning for each fact that may make the map wrong. Such facts
/// are float32 coordinates that are too large for the resolution, and points that are not finite or too far away.
/// Unclassified points among classified ones are a third.
/// @param classes  meanings as configured, with semantics enabled
/// @throws ConfigError if no point can mark a voxel. Either no class has a meaning, or all points lie outside the
///   extents or far from the flight box. The error names the counts per class and the file's properties.
std::vector<MapRemark> report_cloud(const CloudSource& source, const CloudFile& cloud, const ClassMeanings& classes,
                                    const MapperConfig& config, const Box& flight_box);

/// Returns one line on the leaves of an OctoMap, and one if the map's voxels are coarser than the OctoMap's.
/// @throws ConfigError if no leaf lies inside the extents and in or near the flight box
std::vector<MapRemark> report_octomap(const CloudSource& source, const OctoMapFile& octomap, const MapperConfig& config,
                                      const Box& flight_box);

}  // namespace tern
