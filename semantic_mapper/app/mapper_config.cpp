#include "semantic_mapper/app/mapper_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "core/world/names.h"
#include "semantic_mapper/sources/class_names.h"

namespace tern {
namespace {

const std::vector<std::string> kLabelWords(kWords<VoxelLabel>.begin(), kWords<VoxelLabel>.end());
/// The range of origins: surveys use distant ones, in any unit.
const Range kFileCoordinate = Range::within(1e9);
const Range kPosition = Range::within(1e5);

const std::vector<std::pair<std::string, std::string>> kDefaultClasses{
    {"ground", "occupied"}, {"building", "occupied"},     {"bridge_deck", "occupied"}, {"tower", "occupied"},
    {"wire", "occupied"},   {"vegetation", "attractive"}, {"water", "repulsive"}};

using NamedLabels = std::vector<std::pair<std::string, VoxelLabel>>;

NamedLabels::value_type read_class(ConfigSection& classes, const std::string& name, const std::string& fallback) {
  if (class_numbers(name).empty())
    throw classes.error(name, "is not a class, a group of classes or a number from 0 to 255");
  return {name, *named<VoxelLabel>(classes.choice(name, fallback, kLabelWords, "label of the points of this class"))};
}

NamedLabels read_given_classes(ConfigSection classes) {
  NamedLabels result;
  for (const std::string& name : classes.keys()) result.push_back(read_class(classes, name, ""));
  return result;
}

NamedLabels read_classes(ConfigSection classes, bool is_given) {
  if (is_given) return read_given_classes(std::move(classes));
  NamedLabels result;
  for (const auto& [name, label] : kDefaultClasses) result.push_back(read_class(classes, name, label));
  return result;
}

constexpr std::array<std::pair<const char*, CloudFormat>, 11> kEndings{{{".las", CloudFormat::Las},
                                                                        {".laz", CloudFormat::Las},
                                                                        {".ply", CloudFormat::Ply},
                                                                        {".pcd", CloudFormat::Pcd},
                                                                        {".xyz", CloudFormat::Text},
                                                                        {".txt", CloudFormat::Text},
                                                                        {".asc", CloudFormat::Text},
                                                                        {".csv", CloudFormat::Text},
                                                                        {".pts", CloudFormat::Text},
                                                                        {".bt", CloudFormat::OctoMap},
                                                                        {".ot", CloudFormat::OctoMap}}};
const std::vector<std::string> kFormats{"las", "ply", "pcd", "text", "octomap"};  ///< in the order of CloudFormat

/// By the file's ending, if the format is not given.
CloudFormat read_format(ConfigSection& section, const std::string& file) {
  std::string ending = std::filesystem::path(file).extension();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  const auto known = std::find_if(kEndings.begin(), kEndings.end(), [&](const auto& e) { return e.first == ending; });
  const bool is_known = known != kEndings.end();
  const std::string& by_ending = kFormats[is_known ? idx(known->second) : 0];
  const bool is_given = section.has("format");
  const std::string format =
      section.choice("format", by_ending, kFormats, "file format; by default that of the file name's ending");
  if (!is_given && !is_known) {
    throw section.error("file", fmt::format("{}: files {} are not read; LAS (*.las, *.laz), PLY (*.ply), PCD (*.pcd), "
                                            "OctoMap (*.bt, *.ot) and text (*.xyz, *.txt, *.asc, *.csv, *.pts) are. "
                                            "`format` says which of them it is, if its name does not",
                                            file, ending.empty() ? "without an ending" : "named *" + ending));
  }
  return static_cast<CloudFormat>(std::find(kFormats.begin(), kFormats.end(), format) - kFormats.begin());
}

/// Refuses keys that have no effect on the source's format.
void refuse_other_keys(ConfigSection& section, CloudFormat format) {
  if (format == CloudFormat::Las && section.has("label")) {
    throw section.error("label", "names a property or column, and LAS files have none: their class is a field");
  }
  if (format != CloudFormat::OctoMap) return;
  for (const char* key : {"label", "classes", "min_points", "point_radius_m", "fill_below"}) {
    if (section.has(key)) throw section.error(key, "is a key for points; an OctoMap has none");
  }
}

/// "building, tower" as its words.
std::vector<std::string> read_class_list(ConfigSection& section, const char* key) {
  std::vector<std::string> names;
  std::string word;
  for (const char c :
       section.text(key, "", "classes whose columns are filled down to the floor, as \"building, tower\"") + ',') {
    if (c != ',' && c != ' ') {
      word += c;
      continue;
    }
    if (word.empty()) continue;
    if (class_numbers(word).empty()) throw section.error(key, word + " is not a class or group of classes");
    names.push_back(std::exchange(word, {}));
  }
  return names;
}

CloudSource read_source(ConfigSection section) {
  CloudSource source;
  source.section = section;
  source.file =
      section.required_text("file", "path: absolute, beside the scenario, or in `TERN_DATA` (else `../shared/data`)");
  if (source.file.empty()) throw section.error("file", "must name a file");
  source.format = read_format(section, source.file);
  refuse_other_keys(section, source.format);
  source.label = section.text("label", "",
                              "the property or column that holds the class, or the column's number where a text file "
                              "names none; without it, the usual names");
  source.classes = read_given_classes(section.section("classes"));
  source.frame.origin = section.vec3("origin", source.frame.origin, kFileCoordinate,
                                     "subtracted from the file's coordinates, in its units");
  source.frame.metres_per_unit = section.number("metres_per_unit", source.frame.metres_per_unit, Range::positive(1e6),
                                                "length of the file's unit, m: 0.3048 for feet");
  source.min_points =
      static_cast<int>(section.integer("min_points", source.min_points, 1, 1'000'000,
                                       "number of points with one label that a voxel needs to get that label"));
  source.point_radius =
      section.number("point_radius_m", source.point_radius, Range::at_least(0.0, 10.0),
                     "a point also marks voxels whose centre is this near, m; closes gaps of sparse scans");
  source.fill_below = read_class_list(section, "fill_below");
  section.finish();
  return source;
}

Box read_extents(ConfigSection section) {
  const Box box(section.required_vec3("min", kPosition,
                                      "lower corner of the map, m; without `extents` the map covers all sources, and "
                                      "the flight box if that takes at most 8 million voxels"),
                section.required_vec3("max", kPosition, "upper corner of the map, m"));
  section.finish();
  if (!(box.min().array() < box.max().array()).all())
    throw section.error("max", "must be greater than min on every axis");
  return box;
}

LiveConfig read_live(ConfigSection section) {
  LiveConfig live;
  live.enabled = section.flag("enabled", live.enabled,
                              "POINT_CLOUD, DEPTH_IMAGE and MAP_FILE change the map in flight; without `extents` it "
                              "covers the flight box");
  live.period = Duration::from_seconds(section.number("period_s", live.period.seconds(), Range{0.1, 60.0},
                                                      "shortest time between two versions of the map, s"));
  live.range.min = section.number("min_range_m", live.range.min, Range::at_least(0.0, 100.0),
                                  "nearer points are the vehicle's own parts and are ignored, m");
  live.range.max = section.number("max_range_m", live.range.max, Range::positive(1000.0),
                                  "points farther away are free space up to here, m");
  section.finish();
  if (live.range.min >= live.range.max) throw section.error("max_range_m", "must be greater than min_range_m");
  return live;
}

}  // namespace

MapperConfig read_mapper_config(ConfigSection section) {
  MapperConfig config;
  config.resolution = section.number("resolution_m", config.resolution, Range{0.01, 100.0},
                                     "side of a voxel, m; at most 2·10⁸ voxels in all");
  if (section.has("extents")) config.extents = read_extents(section.section("extents"));
  config.voxelize_obstacles = section.flag(
      "voxelize_obstacles", config.voxelize_obstacles,
      "the scenario's static obstacles become occupied voxels; the planner gets their exact boxes in any case");
  config.has_own_classes = section.has("classes");
  config.classes = read_classes(section.section("classes"), section.has("classes"));
  for (const ConfigSection& source : section.list("sources")) config.sources.push_back(read_source(source));
  config.live = read_live(section.section("live"));
  const bool has_octomap = std::any_of(config.sources.begin(), config.sources.end(),
                                       [](const CloudSource& source) { return source.format == CloudFormat::OctoMap; });
  config.background = *named<VoxelLabel>(section.choice(
      "background", has_octomap || config.live.enabled ? "unknown" : "free", {"free", "unknown"},
      "label of voxels without a source; by default `unknown` with an OctoMap or `live`, which have free space"));
  section.finish();
  return config;
}

MapperConfig read_mapper_config(ConfigDocument& document) {
  MapperConfig config = read_mapper_config(document.root().section("mapper"));
  config.mission_file = document.root().section("mission").text("file", "");
  config.fence_uploads = document.root().section("mission").flag("fence_uploads", false);
  return config;
}

}  // namespace tern
