#include "semantic_mapper/app/load_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "runtime/data_folder.h"
#include "semantic_mapper/app/laz.h"
#include "semantic_mapper/sources/class_names.h"
#include "semantic_mapper/sources/las.h"
#include "semantic_mapper/sources/pcd.h"
#include "semantic_mapper/sources/ply.h"
#include "semantic_mapper/sources/text_cloud.h"
#include "semantic_mapper/voxel_map/voxel_painter.h"

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

/// Returns whether points of class 0 and 1 are geometry without a label. These classes of LAS are "never classified"
/// and "unclassified"; beside classified points, `classes` may say what they mean.
bool has_unlabelled(const CloudSource& source, const CloudFile& cloud, const MapperConfig& config) {
  if (source.format != CloudFormat::Las) return !cloud.has_labels;
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
    if (!classes[number]) classes[number] = ClassMeaning{kUnlabelled, VoxelLabel::Occupied};
  }
  return classes;
}

/// A file's name, for errors, and its content.
struct SourceFile {
  std::string path;
  std::vector<std::uint8_t> bytes;
};

SourceFile read_file(const CloudSource& source, const Scenario& scenario, const char* environment) {
  const fs::path path = find_file(source, scenario, environment);
  return {path.string(), read_bytes(path, source)};
}

Result<CloudFile> parse_las_or_laz(const CloudSource& source, const SourceFile& file) {
  if (!is_compressed_las(file.bytes)) return parse_las(file.bytes, file.path, source.frame);
  const auto points = decompress_laz(file.path, unlaz_program(), kMaxCloudBytes);
  if (!points) return tl::unexpected(points.error());
  return parse_las(*points, file.path, source.frame);
}

Result<CloudFile> parse_cloud(const CloudSource& source, const SourceFile& file) {
  switch (source.format) {
    case CloudFormat::Ply: return parse_ply(file.bytes, file.path, source.frame, source.label);
    case CloudFormat::Pcd: return parse_pcd(file.bytes, file.path, source.frame, source.label);
    case CloudFormat::Text: return parse_text_cloud(file.bytes, file.path, source.frame, source.label);
    case CloudFormat::Las:
    case CloudFormat::OctoMap: break;
  }
  return parse_las_or_laz(source, file);
}

}  // namespace

void set_meanings(const std::vector<std::pair<std::string, VoxelLabel>>& named, ClassMeanings& classes) {
  for (const bool groups : {true, false}) {
    for (const auto& [name, label] : named) {
      if (is_class_group(name) != groups) continue;
      for (const std::uint8_t number : class_numbers(name)) classes[number] = ClassMeaning{class_name(number), label};
    }
  }
}

CloudLayer load_cloud(const CloudSource& source, const Scenario& scenario, const MapperConfig& config,
                      const char* environment, std::vector<MapRemark>& remarks) {
  auto cloud = parse_cloud(source, read_file(source, scenario, environment));
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

OctoMapFile load_octomap(const CloudSource& source, const Scenario& scenario, const MapperConfig& config,
                         const char* environment, std::vector<MapRemark>& remarks) {
  const SourceFile file = read_file(source, scenario, environment);
  auto octomap = parse_octomap(file.bytes, file.path, source.frame);
  if (!octomap) throw source.section.error("file", octomap.error().message);
  const auto said = report_octomap(source, *octomap, config, scenario.uav.flight_box);
  remarks.insert(remarks.end(), said.begin(), said.end());
  return std::move(*octomap);
}

}  // namespace tern
