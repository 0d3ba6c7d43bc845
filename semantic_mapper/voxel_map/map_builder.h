// Builds one labelled voxel map from regions, boxes and point clouds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/region.h"
#include "core/world/fence.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "semantic_mapper/sources/octomap.h"
#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// The label of a class and the class name under which voxels get it.
struct ClassMeaning {
  std::string name;
  VoxelLabel label = VoxelLabel::Unknown;
};

/// Meanings by class number; nullopt: points of that class are left out.
using ClassMeanings = std::array<std::optional<ClassMeaning>, 256>;

/// A point cloud, and how its points become voxels.
struct CloudLayer {
  PointCloud points;
  ClassMeanings classes;
  /// By class number; true: the columns below such voxels are filled, down to the map's floor.
  std::array<bool, 256> fill_below{};
  double point_radius = 0.0;  ///< m, ≥ 0: a point marks its voxel and every voxel whose centre is this near
  int min_points = 1;         ///< ≥ 1: number of marks of one label that a voxel needs
};

/// The sources of a map.
struct MapSources {
  std::vector<Region> regions;
  std::vector<std::pair<std::string, VoxelLabel>>
      region_classes;          ///< class name → label, for the class of every region
  std::vector<Box> obstacles;  ///< occupied, with the class "obstacle"
  std::vector<CloudLayer> clouds;
  std::vector<OctoMapFile> octomaps;  ///< occupied and free space (paint_octomap)
  std::vector<Fence> fences;          ///< occupied, of class "fence", where they forbid (fence_labels); none geodetic
};

/// The grid of a map and its background.
struct MapBuildOptions {
  double resolution = 0.25;       ///< m, > 0
  std::optional<Box> extents;     ///< W, m; nullopt: the bounds of all sources, enlarged by `include`
  Box include;                    ///< added to the bounds if the map then has at most kMaxRoomyVoxels (the flight box)
  Vec3 somewhere = Vec3::Zero();  ///< W, m: the start, and position of the single voxel of a map without sources
  VoxelLabel background = VoxelLabel::Free;  ///< label of voxels without a source
  std::optional<Body> body;  ///< a vehicle that stands at `somewhere`: the occupied voxels that it is in become free
};

struct BuiltMap {
  VoxelMap map;
  std::int64_t stood_in = 0;  ///< voxels that were freed, since the vehicle stands in them
  std::string cut;            ///< why points are left out although mapper.extents is not given; "" if none are
};

/// `include` enlarges the bounds only if the map then has at most this many voxels.
inline constexpr std::int64_t kMaxRoomyVoxels = 8'000'000;

/// Returns the map of all sources. O(voxels + points·(point_radius/resolution)³ + points·log(points)).
///
/// 1. If sources disagree about a voxel, the stronger label is kept: occupied > repulsive > attractive > free >
///    unknown. Of equal labels the class of the first source is kept: regions, then obstacles, clouds and OctoMaps.
/// 2. Occupied regions and obstacles mark every voxel that they overlap. (A prism also marks voxels within half a
///    voxel's diagonal of its outline.) Other regions mark the voxels whose centre they contain.
/// 3. The grid's corner is a multiple of the resolution, so the voxels do not depend on the extents. Sources are cut
///    at the extents.
/// 4. Voxels in which the vehicle stands become free (voxels_stood_in).
/// 5. Without extents, a map that would be too large is cut to the flight box, `include`: a few stray points must not
///    refuse a cloud.
/// 6. Without extents the grid covers the fences (fenced_box). They are painted last, so that nothing frees their
///    voxels.
///
/// @return an Error with extents and limits if the map would have more than kMaxVoxels. An Error with min_points if no
///   voxel of a cloud reaches that number of marks. An Error with the extents if they end within a fence, and one if
///   the body at `somewhere` overlaps voxels that a fence forbids.
Result<BuiltMap> build_map(const MapSources& sources, const MapBuildOptions& options);

}  // namespace tern
