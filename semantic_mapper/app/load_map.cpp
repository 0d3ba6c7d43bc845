#include "semantic_mapper/app/load_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/world/names.h"
#include "runtime/data_folder.h"
#include "semantic_mapper/sources/class_names.h"
#include "semantic_mapper/sources/las.h"
#include "semantic_mapper/sources/ply.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

fs::path find_file(const CloudSource& source, const Scenario& scenario, const char* environment) {
  const std::string data = data_folder(scenario.file, environment);
  std::vector<fs::path> places{fs::path(scenario.file).parent_path() / source.file};
  if (!data.empty()) places.push_back(fs::path(data) / source.file);
  std::string tried;
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (fs::is_regular_file(place, ignored)) return place;
    tried += (tried.empty() ? "" : ", ") + place.lexically_normal().string();
  }
  throw source.section.error(
      "file", fmt::format("{} not found (searched: {}; set TERN_DATA to the folder of the data)", source.file, tried));
}

std::vector<std::uint8_t> read_bytes(const fs::path& file, const CloudSource& source) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw source.section.error("file", fmt::format("{}: {}", file.string(), error.message()));
  if (size > kMaxCloudBytes) {
    throw source.section.error("file", fmt::format("{} has {} bytes (limit {})", file.string(), size, kMaxCloudBytes));
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw source.section.error("file", fmt::format("{} cannot be read", file.string()));
  }
  return bytes;
}

bool is_kept(VoxelLabel label, bool semantics) {
  return semantics || (label != VoxelLabel::Attractive && label != VoxelLabel::Repulsive);
}

/// Sets the meanings of the classes that are named. A class named itself overrules its group.
void set_meanings(const std::vector<std::pair<std::string, VoxelLabel>>& named, ClassMeanings& classes) {
  for (const bool groups : {true, false}) {
    for (const auto& [name, label] : named) {
      if (is_class_group(name) != groups) continue;
      for (const std::uint8_t number : class_numbers(name)) classes[number] = ClassMeaning{class_name(number), label};
    }
  }
}

/// Returns whether points of class 0 and 1 are geometry without a label. These classes of LAS are "never classified"
/// and "unclassified"; beside classified points, `classes` may say what they mean.
bool has_unlabelled(const CloudSource& source, const CloudFile& cloud, const MapperConfig& config) {
  if (source.format == CloudFormat::Ply) return !cloud.has_labels;
  if (!config.has_own_classes && source.classes.empty()) return true;
  return std::all_of(cloud.points.begin(), cloud.points.end(),
                     [](const LabelledPoint& point) { return point.class_number <= 1; });
}

ClassMeanings meanings_of(const CloudSource& source, const CloudFile& cloud, const MapperConfig& config) {
  ClassMeanings classes;
  set_meanings(config.classes, classes);
  set_meanings(source.classes, classes);
  if (!has_unlabelled(source, cloud, config)) return classes;
  for (const std::size_t number : {0U, 1U}) {
    if (!classes[number]) classes[number] = ClassMeaning{"unlabelled", VoxelLabel::Occupied};
  }
  return classes;
}

CloudLayer load_cloud(const CloudSource& source, const Scenario& scenario, const MapperConfig& config,
                      const char* environment, std::vector<MapRemark>& remarks) {
  const fs::path file = find_file(source, scenario, environment);
  const std::vector<std::uint8_t> bytes = read_bytes(file, source);
  auto cloud = source.format == CloudFormat::Las ? parse_las(bytes, file.string(), source.frame)
                                                 : parse_ply(bytes, file.string(), source.frame, source.label);
  if (!cloud) throw source.section.error("file", cloud.error().message);
  CloudLayer layer;
  layer.classes = meanings_of(source, *cloud, config);
  const auto said = report_cloud(source, *cloud, layer.classes, config, scenario.uav.flight_box);
  remarks.insert(remarks.end(), said.begin(), said.end());
  for (auto& meaning : layer.classes) {
    if (meaning && !is_kept(meaning->label, scenario.semantics.enabled)) meaning.reset();
  }
  layer.points = std::move(cloud->points);
  for (const std::string& name : source.fill_below) {
    for (const std::uint8_t number : class_numbers(name)) layer.fill_below[number] = true;
  }
  layer.point_radius = source.point_radius;
  layer.min_points = source.min_points;
  return layer;
}

}  // namespace

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
  for (const CloudSource& source : config.sources)
    sources.clouds.push_back(load_cloud(source, scenario, config, environment, loaded.remarks));

  MapBuildOptions options;
  options.resolution = config.resolution;
  options.extents = config.extents;
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
