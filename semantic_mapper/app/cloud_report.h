// Reports what a map uses of a file, and refuses a file without effect.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {

/// A sentence for the user about one source.
struct MapRemark {
  std::string text;
  bool is_warning = false;
};

/// Logs the remarks, warnings as such.
void log_remarks(const std::vector<MapRemark>& remarks);

/// Returns the warnings in one text, by "; ".
std::string warnings_of(const std::vector<MapRemark>& remarks);

/// Returns one line on the points that are used, and a warning for each fact that may make the map wrong:
///
/// * float32 coordinates that are too large for the resolution;
/// * points that are not finite or too far away;
/// * unclassified points among classified ones;
/// * no point in or near the flight box.
///
/// A cloud outside the flight box, such as trees above it, is used if the given extents overlap the box and contain
/// points. Without such extents it is refused: most likely it is in another frame, and the map would be free.
/// @param classes  meanings as configured, with semantics enabled
/// @throws ConfigError if no point can mark a voxel. The error names the counts per class and the file's properties.
///   Either no class has a meaning, all points lie outside the extents, or they lie outside the flight box without such
///   extents.
std::vector<MapRemark> report_cloud(const CloudSource& source, const CloudFile& cloud, const ClassMeanings& classes,
                                    const MapperConfig& config, const Box& flight_box);

/// Returns one line on the leaves of an OctoMap, and one if the map's voxels are coarser than the OctoMap's.
/// An OctoMap outside the flight box is used or refused as a cloud is.
/// @throws ConfigError if no leaf lies inside the extents, or all lie outside the flight box without such extents
std::vector<MapRemark> report_octomap(const CloudSource& source, const OctoMapFile& octomap, const MapperConfig& config,
                                      const Box& flight_box);

}  // namespace tern
