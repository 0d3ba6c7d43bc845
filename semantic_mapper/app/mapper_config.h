// The section `mapper:` of a scenario file.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/world/voxel_map.h"
#include "runtime/config.h"
#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

enum class CloudFormat { Las, Ply };

struct CloudSource {
  std::string file;  ///< as the scenario names it
  CloudFormat format = CloudFormat::Las;
  PointFrame frame;
  int min_points = 1;
  double point_radius = 0.0;            ///< m
  std::vector<std::string> fill_below;  ///< class names
  ConfigSection section;                ///< where it was read: for errors that show only when the file is opened
};

struct MapperConfig {
  double resolution = 0.25;    ///< m
  std::optional<Box> extents;  ///< W, m
  VoxelLabel background = VoxelLabel::Free;
  bool voxelize_obstacles = false;
  std::vector<std::pair<std::string, VoxelLabel>> classes;  ///< point clouds': class or group name → label
  std::vector<CloudSource> sources;
};

/// Reads and finishes the section; README.md is the table of keys. @throws ConfigError.
MapperConfig read_mapper_config(ConfigSection section);

}  // namespace tern
