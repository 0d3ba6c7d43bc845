// The inputs of a live map, apart from the map of the files.
#pragma once

#include <optional>

#include "core/scenario/scenario.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/voxel_map/live_map.h"

namespace tern {

struct LiveSetup {
  ClassMeanings classes;  ///< of the points of scans with classes
  ScanRange range;
  Duration period;               ///< between two versions of the map, > 0
  Body body;                     ///< the vehicle's
  Vec3 position = Vec3::Zero();  ///< of the vehicle until its first UAV_STATE, W, m
};

/// Returns the setup of `mapper.live`; nullopt if it is not enabled. Points of class 0 and 1 are occupied, as in files,
/// unless `mapper.classes` is given.
std::optional<LiveSetup> live_setup(const Scenario& scenario, const MapperConfig& config);

}  // namespace tern
