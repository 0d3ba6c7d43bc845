// The section `mapper:` of a scenario.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/world/voxel_map.h"
#include "runtime/config.h"
#include "semantic_mapper/sources/point_cloud.h"
#include "semantic_mapper/voxel_map/live_map.h"

namespace tern {

/// The format of a file. Text is a point per line.
enum class CloudFormat { Las, Ply, Pcd, Text, OctoMap };

/// One file: a point cloud and how its points become voxels (CloudLayer), or an OctoMap.
struct CloudSource {
  std::string file;  ///< as written in the scenario
  CloudFormat format = CloudFormat::Las;
  PointFrame frame;
  int min_points = 1;
  double point_radius = 0.0;            ///< m
  std::vector<std::string> fill_below;  ///< class names
  std::string label;                    ///< the property or column that is the class; "": by the usual names
  std::vector<std::pair<std::string, VoxelLabel>> classes;  ///< class or group name → label; has priority over the
                                                            ///< map's own
  ConfigSection section;  ///< the section, for errors that are found when the file is opened
};

/// The changes of the map by POINT_CLOUD and DEPTH_IMAGE.
struct LiveConfig {
  bool enabled = false;
  Duration period{500'000};  ///< shortest time between two versions of the map
  ScanRange range;
};

/// The configuration of tern-mapper.
struct MapperConfig {
  double resolution = 0.25;    ///< m
  std::optional<Box> extents;  ///< W, m
  VoxelLabel background = VoxelLabel::Free;
  bool voxelize_obstacles = false;
  std::vector<std::pair<std::string, VoxelLabel>> classes;  ///< of point clouds: class or group name → label
  bool has_own_classes = false;                             ///< false: `classes` are the defaults
  std::vector<CloudSource> sources;
  LiveConfig live;
  std::string mission_file;    ///< mission.file of the scenario: its fences are in force; "": none
  bool fence_uploads = false;  ///< mission.fence_uploads: FENCES are in force as well
};

/// Reads the section and checks that it has no further keys. The keys are listed in docs/reference/keys.md.
/// @throws ConfigError
MapperConfig read_mapper_config(ConfigSection section);
/// Reads the section `mapper`, and `mission.file` and `mission.fence_uploads`. @throws ConfigError
MapperConfig read_mapper_config(ConfigDocument& document);

}  // namespace tern
