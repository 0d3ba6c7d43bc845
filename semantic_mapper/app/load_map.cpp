#include "semantic_mapper/app/load_map.h"

#include <fmt/format.h>

#include "core/world/names.h"
#include "semantic_mapper/app/load_fences.h"
#include "semantic_mapper/app/load_source.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {

LoadedMap load_map(const Scenario& scenario, const MapperConfig& config, const char* environment) {
  MapSources sources;
  LoadedMap loaded;
  for (const auto& [name, word] : scenario.semantics.classes) {
    sources.region_classes.emplace_back(name, *named<VoxelLabel>(word));
  }
  for (const Region& region : scenario.semantics.regions) {
    for (const auto& [name, label] : sources.region_classes) {
      if (name == region.class_name && is_kept(label, scenario.semantics.enabled)) sources.regions.push_back(region);
    }
  }
  for (const ObstacleSpec& obstacle : scenario.world.obstacles) {
    const bool rests = std::holds_alternative<StaticMotion>(obstacle.motion);
    if (config.voxelize_obstacles && rests)
      sources.obstacles.push_back(box_around(obstacle.centre, obstacle.half_extents));
  }
  for (const CloudSource& source : config.sources) {
    if (source.format == CloudFormat::OctoMap) {
      sources.octomaps.push_back(load_octomap(source, scenario, config, environment, loaded.remarks));
    } else {
      sources.clouds.push_back(load_cloud(source, scenario, config, environment, loaded.remarks));
    }
  }
  sources.fences = load_fences(scenario, config, loaded.remarks);

  MapBuildOptions options;
  options.resolution = config.resolution;
  options.extents = config.extents;
  if (!options.extents && config.live.enabled) options.extents = scenario.uav.flight_box;
  options.include = scenario.uav.flight_box;
  options.somewhere = scenario.uav.start;
  options.background = config.background;
  options.body = scenario.uav.body;
  BuiltMap built = value_or_throw(build_map(sources, options), scenario.file + ": mapper: ");
  loaded.map = std::move(built.map);
  if (!built.cut.empty()) loaded.remarks.push_back({built.cut, true});
  if (built.stood_in > 0) {
    loaded.remarks.push_back(
        {fmt::format("the vehicle at uav.start stands in {} occupied voxels; they are free", built.stood_in)});
  }
  return loaded;
}

}  // namespace tern
