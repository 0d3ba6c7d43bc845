#include "semantic_mapper/voxel_map/map_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/world/fence_voxels.h"
#include "semantic_mapper/voxel_map/cloud_voxels.h"
#include "semantic_mapper/voxel_map/octomap_voxels.h"
#include "semantic_mapper/voxel_map/standing_place.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

namespace tern {
namespace {

/// A tolerance, in voxels, so that rounding does not add a layer of voxels.
constexpr double kSnap = 1e-6;
/// A tolerance, in voxels: shapes that touch a voxel do not overlap it.
constexpr double kTouch = 1e-9;

Box bounds_of(const MapSources& sources) {
  Box box;
  for (const Region& region : sources.regions) box.extend(region.bounds());
  for (const Box& obstacle : sources.obstacles) box.extend(obstacle);
  for (const CloudLayer& cloud : sources.clouds) {
    for (const LabelledPoint& point : cloud.points) {
      if (cloud.classes[point.class_number]) box.extend(point.position);
    }
  }
  for (const OctoMapFile& octomap : sources.octomaps) {
    for (const OctoLeaf& leaf : octomap.leaves) box.extend(octomap.box(leaf));
  }
  return box;
}

/// Voxels per axis as doubles, so that the product of very large extents does not overflow.
struct Lattice {
  Vec3 first, size;
};
Lattice lattice_of(const Box& box, double resolution) {
  const Vec3 first = (box.min() / resolution + Vec3::Constant(kSnap)).array().floor();
  const Vec3 end = (box.max() / resolution - Vec3::Constant(kSnap)).array().ceil();
  return {first, (end - first).cwiseMax(1.0)};
}

bool is_too_large(const Lattice& lattice) { return lattice.size.prod() > static_cast<double>(kMaxVoxels); }

/// The grid's box, and why it is smaller than the sources.
struct Room {
  Box box;
  std::string cut;
};

Room choose_room(const MapSources& sources, const MapBuildOptions& options) {
  if (options.extents) return {*options.extents, ""};
  Box box = bounds_of(sources);
  box.extend(fenced_box(sources.fences, options.include, options.resolution));
  if (box.isEmpty()) box = Box(options.somewhere, options.somewhere);
  if (options.include.isEmpty()) return {box, ""};
  const Box roomy = box.merged(options.include);
  if (lattice_of(roomy, options.resolution).size.prod() <= static_cast<double>(kMaxRoomyVoxels)) return {roomy, ""};
  if (!is_too_large(lattice_of(box, options.resolution))) return {box, ""};
  const Box core = box.intersection(options.include);
  if (core.isEmpty() || is_too_large(lattice_of(core, options.resolution))) return {box, ""};
  return {core, fmt::format("the sources reach over {:g} × {:g} × {:g} m, too many voxels of {:g} m: the map is cut to "
                            "uav.flight_box. Stray points? Give mapper.extents",
                            box.sizes().x(), box.sizes().y(), box.sizes().z(), options.resolution)};
}

Result<VoxelGrid> grid_over(const Box& box, const MapSources& sources, const MapBuildOptions& options) {
  const Lattice lattice = lattice_of(box, options.resolution);
  if (is_too_large(lattice)) {
    return fail(fmt::format(
        "a map of {:g} × {:g} × {:g} m takes {:g} voxels of {} m (limit {}): give smaller extents or a "
        "coarser resolution{}",
        box.sizes().x(), box.sizes().y(), box.sizes().z(), lattice.size.prod(), options.resolution, kMaxVoxels,
        sources.fences.empty() ? "" : ". A map with fences covers them inside uav.flight_box: state a smaller one"));
  }
  VoxelGrid grid;
  grid.origin = lattice.first * options.resolution;
  grid.resolution = options.resolution;
  grid.size = lattice.size.cast<int>();
  return grid;
}

/// True if the shape overlaps the interior of the voxel.
bool overlaps(const Box& shape, const Box& voxel) {
  const double touch = kTouch * voxel.sizes().x();
  return (shape.min().array() < voxel.max().array() - touch).all() &&
         (shape.max().array() > voxel.min().array() + touch).all();
}

bool overlaps(const Region& region, const Box& voxel) {
  const double touch = kTouch * voxel.sizes().x();
  if (const auto* box = std::get_if<Box>(&region.shape)) return overlaps(*box, voxel);
  if (const auto* ball = std::get_if<BallRegion>(&region.shape)) {
    return voxel.exteriorDistance(ball->centre) < ball->radius - touch;
  }
  const auto& prism = std::get<PrismRegion>(region.shape);
  if (voxel.max().z() <= prism.z_min + touch || voxel.min().z() >= prism.z_max - touch) return false;
  Vec3 p = voxel.center();
  p.z() = std::clamp(p.z(), prism.z_min, prism.z_max);
  return region.distance(p) < std::sqrt(0.5) * voxel.sizes().x() - touch;
}

void paint_region(const Region& region, VoxelLabel label, VoxelPainter& painter) {
  const std::uint8_t index = painter.class_index(region.class_name);
  painter.paint_if(region.bounds(), label, index, [&](const Box& voxel) {
    return label == VoxelLabel::Occupied ? overlaps(region, voxel) : region.contains(voxel.center());
  });
}

VoxelLabel label_of(const std::string& class_name, const MapSources& sources) {
  for (const auto& [name, label] : sources.region_classes) {
    if (name == class_name) return label;
  }
  return VoxelLabel::Unknown;
}

/// A map that ends within a fence has no wall there.
Result<void> check_extents(const MapSources& sources, const MapBuildOptions& options, const VoxelGrid& grid) {
  const Box needed = fenced_box(sources.fences, options.include, options.resolution);
  if (needed.isEmpty() || grown(grid.bounds(), Vec3::Constant(kFenceTouch)).contains(needed)) return {};
  const Vec3 &low = needed.min(), &high = needed.max();
  return fail(fmt::format(
      "extents end within the fences: they must contain ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m, the part of the "
      "fences inside uav.flight_box and a voxel around inclusion fences",
      low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
}

/// Makes what the fences forbid occupied, whatever other sources say.
Result<void> paint_fences(const MapSources& sources, const MapBuildOptions& options, VoxelPainter& painter) {
  const VoxelGrid& grid = painter.grid();
  const std::vector<VoxelLabel> labels = fence_labels(sources.fences, grid);
  if (options.body && !voxels_overlapped(grid, labels, *options.body, options.somewhere).empty()) {
    const Vec3& p = options.somewhere;
    return fail(
        fmt::format("the vehicle at uav.start, ({:g}, {:g}, {:g}) m, is beyond a fence, or less than a voxel of "
                    "{:g} m from it",
                    p.x(), p.y(), p.z(), grid.resolution));
  }
  const std::uint8_t name = painter.class_index("fence");
  for (std::int64_t k = 0; k < grid.voxels(); ++k) {
    if (labels[idx(k)] == VoxelLabel::Occupied) painter.paint(k, VoxelLabel::Occupied, name);
  }
  return {};
}

}  // namespace

Result<BuiltMap> build_map(const MapSources& sources, const MapBuildOptions& options) {
  Room room = choose_room(sources, options);
  const auto grid = grid_over(room.box, sources, options);
  if (!grid) return tl::unexpected(grid.error());
  if (const auto fits = check_extents(sources, options, *grid); !fits) return tl::unexpected(fits.error());
  VoxelPainter painter(*grid, options.background);
  for (const Region& region : sources.regions) paint_region(region, label_of(region.class_name, sources), painter);
  for (const Box& obstacle : sources.obstacles) {
    painter.paint_if(obstacle, VoxelLabel::Occupied, painter.class_index("obstacle"),
                     [&](const Box& voxel) { return overlaps(obstacle, voxel); });
  }
  for (std::size_t k = 0; k < sources.clouds.size(); ++k) {
    if (paint_cloud(sources.clouds[k], painter)) continue;
    return fail(
        fmt::format("sources[{}].min_points: no voxel has {} marks of one label", k, sources.clouds[k].min_points));
  }
  for (const OctoMapFile& octomap : sources.octomaps) paint_octomap(octomap, painter);
  BuiltMap built;
  if (options.body) built.stood_in = painter.free_standing_place(*options.body, options.somewhere);
  if (!sources.fences.empty()) {
    if (const auto painted = paint_fences(sources, options, painter); !painted) return tl::unexpected(painted.error());
  }
  built.map = painter.finish();
  built.cut = std::move(room.cut);
  return built;
}

}  // namespace tern
