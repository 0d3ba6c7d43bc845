#include "semantic_mapper/app/mapper_config.h"

#include <fmt/format.h>

#include <filesystem>

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

/// By the file's ending, if the format is not given.
CloudFormat read_format(ConfigSection& section, const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension();
  const bool is_ply = ending == ".ply" || ending == ".PLY";
  const bool is_given = section.has("format");
  const std::string format = section.choice("format", is_ply ? "ply" : "las", {"las", "ply"},
                                            "file format; by default that of the file name's ending");
  const bool is_known = is_ply || ending == ".las" || ending == ".LAS" || ending == ".laz" || ending == ".LAZ";
  if (!is_given && !is_known) {
    throw section.error("file", fmt::format("{}: files {} are not read; LAS (*.las) and PLY (*.ply) are. "
                                            "`format` says which of them it is, if its name does not",
                                            file, ending.empty() ? "without an ending" : "named *" + ending));
  }
  return format == "ply" ? CloudFormat::Ply : CloudFormat::Las;
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
  source.label = section.text("label", "", "the PLY property that holds the class; without it, the usual names");
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
  if (!source.label.empty() && source.format != CloudFormat::Ply) {
    throw section.error("label", "names a property, which only PLY files have");
  }
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

}  // namespace

MapperConfig read_mapper_config(ConfigSection section) {
  MapperConfig config;
  config.resolution = section.number("resolution_m", config.resolution, Range{0.01, 100.0},
                                     "side of a voxel, m; at most 2·10⁸ voxels in all");
  if (section.has("extents")) config.extents = read_extents(section.section("extents"));
  config.background =
      *named<VoxelLabel>(section.choice("background", "free", {"free", "unknown"}, "label of voxels without a source"));
  config.voxelize_obstacles = section.flag(
      "voxelize_obstacles", config.voxelize_obstacles,
      "the scenario's static obstacles become occupied voxels; the planner gets their exact boxes in any case");
  config.has_own_classes = section.has("classes");
  config.classes = read_classes(section.section("classes"), section.has("classes"));
  for (const ConfigSection& source : section.list("sources")) config.sources.push_back(read_source(source));
  section.finish();
  return config;
}

}  // namespace tern
