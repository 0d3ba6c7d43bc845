// Regions, boxes and point clouds become one labelled voxel map.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/world/region.h"
#include "core/world/voxel_map.h"
#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// What a class means: a label, under a name.
struct ClassMeaning {
  std::string name;
  VoxelLabel label = VoxelLabel::Unknown;
};

/// A point cloud and how its points become voxels.
struct CloudLayer {
  PointCloud points;
  std::array<std::optional<ClassMeaning>, 256> classes;  ///< by class number; none: such points are left out
  std::array<bool, 256>
      fill_below{};           ///< voxels of these classes stand on columns of the same, down to the map's floor
  double point_radius = 0.0;  ///< m, ≥ 0: a point marks every voxel whose centre is this near (and its own)
  int min_points = 1;         ///< ≥ 1: a voxel needs so many points of one label
};

struct MapSources {
  std::vector<Region> regions;
  std::vector<std::pair<std::string, VoxelLabel>> region_classes;  ///< class name → label, for every region's class
  std::vector<Box> obstacles;                                      ///< become occupied, class "obstacle"
  std::vector<CloudLayer> clouds;
};

struct MapBuildOptions {
  double resolution = 0.25;       ///< m, > 0
  std::optional<Box> extents;     ///< of the map; without: bounds of all sources, and what `include` adds
  Box include;                    ///< added to the bounds when that takes no more than kMaxRoomyVoxels (the flight box)
  Vec3 somewhere = Vec3::Zero();  ///< where the single voxel lies of a map that would be empty
  VoxelLabel background = VoxelLabel::Free;  ///< of voxels that no source speaks of
};

/// Where a map's extents are our choice, it stays handy.
inline constexpr std::int64_t kMaxRoomyVoxels = 8'000'000;

/// Where sources disagree about a voxel, the stronger label stays: occupied > repulsive > attractive > free > unknown.
/// Of equal labels the first source's class stays, regions before obstacles before clouds.
///
/// Regions labelled occupied and obstacles mark every voxel that they overlap, so nothing solid is lost. (A prism also
/// marks voxels whose square only comes within the half-diagonal of its outline.) Other regions mark the voxels whose
/// centre they contain. The grid's corner lies on a multiple of the resolution, so equal sources give equal voxels
/// whatever the extents. Sources outside the extents are cut. Fails when the map would have more than kMaxVoxels,
/// naming extents and limits. O(voxels + points·(point_radius/resolution)³ + points·log(points)).
Result<VoxelMap> build_map(const MapSources& sources, const MapBuildOptions& options);

}  // namespace tern
