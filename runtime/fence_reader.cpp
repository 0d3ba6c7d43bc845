#include "runtime/fence_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>

#include "runtime/polygon.h"

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Range kPosition = Range::within(1e5);
const Range kRadius = Range::positive(1e5);
/// As of regions: the test for crossings takes every pair of edges.
constexpr std::size_t kMaxCorners = 1'000;
constexpr std::size_t kMaxNameBytes = 64;

/// A floor or ceiling; infinite without the key.
double read_level(ConfigSection& section, const char* key, double fallback) {
  return section.has(key) ? section.required_number(key, kPosition) : fallback;
}

template <class Levels>
void read_levels(ConfigSection& section, Levels& fence) {
  fence.floor = read_level(section, "floor", -kInfinity);
  fence.ceiling = read_level(section, "ceiling", kInfinity);
}

template <class Levels>
void check_levels(const ConfigSection& section, const Levels& fence) {
  if (!(fence.floor < fence.ceiling)) throw section.error("ceiling", "must be greater than floor");
}

FencePolygon read_polygon(ConfigSection& section, const char* key, bool is_geodetic) {
  FencePolygon polygon;
  for (const std::vector<double>& row : section.rows(key, 2, is_geodetic ? Range::within(180.0) : kPosition)) {
    polygon.corners.emplace_back(row[0], row[1]);
    if (is_geodetic && std::abs(row[0]) > 90.0) {
      throw section.error(key, fmt::format("latitude {} is out of range [-90, 90]", row[0]));
    }
  }
  const std::size_t count = polygon.corners.size();
  if (count < 3 || count > kMaxCorners) {
    throw section.error(key, fmt::format("{} corners (limit 3 to {})", count, kMaxCorners));
  }
  if (!is_simple_polygon(polygon.corners)) throw section.error(key, "the polygon touches or crosses itself");
  return polygon;
}

FenceCircle read_circle(ConfigSection section, bool& is_geodetic) {
  FenceCircle circle;
  is_geodetic = section.has("latitude") || section.has("longitude");
  if (is_geodetic) {
    circle.centre = {section.required_number("latitude", Range::within(90.0)),
                     section.required_number("longitude", Range::within(180.0))};
  } else {
    const std::vector<double> centre = section.numbers("centre", {}, kPosition);
    if (centre.size() != 2) throw section.error("centre", fmt::format("{} numbers (give x and y)", centre.size()));
    circle.centre = {centre[0], centre[1]};
  }
  circle.radius = section.required_number("radius", kRadius);
  section.finish();
  return circle;
}

Fence read_fence(ConfigSection section, std::set<std::string>& names) {
  Fence fence;
  fence.name = section.text("name", "");
  if (fence.name.size() > kMaxNameBytes) {
    throw section.error("name", fmt::format("has {} bytes (limit {})", fence.name.size(), kMaxNameBytes));
  }
  fence.is_inclusion = section.choice("kind", "inclusion", {"inclusion", "exclusion"}) == "inclusion";
  read_levels(section, fence);
  const bool has_corners = section.has("corners"), has_coordinates = section.has("coordinates");
  const bool has_circle = section.has("circle");
  if (has_circle) {
    fence.shape = read_circle(section.section("circle"), fence.is_geodetic);
  } else if (has_coordinates) {
    fence.is_geodetic = true;
    fence.shape = read_polygon(section, "coordinates", true);
  } else if (has_corners) {
    fence.shape = read_polygon(section, "corners", false);
  }
  section.finish();
  if (int{has_corners} + int{has_coordinates} + int{has_circle} != 1) {
    throw section.error("kind", "needs one shape: corners, coordinates, circle or file");
  }
  if (!fence.name.empty() && !names.insert(fence.name).second) {
    throw section.error("name", fence.name + " is also the name of another fence");
  }
  check_levels(section, fence);
  return fence;
}

FenceFile read_fence_file(ConfigSection section) {
  FenceFile file;
  file.file = section.required_text("file");
  read_levels(section, file);
  section.finish();
  if (file.file.empty()) throw section.error("file", "must name a file");
  check_levels(section, file);
  return file;
}

}  // namespace

void read_origin_and_fences(ConfigSection& world, WorldSpec& spec) {
  if (world.has("origin")) {
    ConfigSection origin = world.section("origin");
    spec.origin = GeodeticPoint{origin.required_number("latitude", Range::within(90.0)),
                                origin.required_number("longitude", Range::within(180.0)),
                                origin.number("height", 0.0, Range::within(1e5))};
    origin.finish();
  }
  const std::vector<ConfigSection> fences = world.list("fences");
  if (fences.size() > kMaxFences) {
    throw world.error("fences", fmt::format("{} of them (limit {})", fences.size(), kMaxFences));
  }
  std::set<std::string> names;
  for (ConfigSection entry : fences) {
    if (entry.has("file")) {
      spec.fence_files.push_back(read_fence_file(entry));
      continue;
    }
    spec.fences.push_back(read_fence(entry, names));
    if (spec.fences.back().is_geodetic && !spec.origin) {
      throw entry.error("kind", "has latitudes and longitudes, which need world.origin");
    }
  }
}

}  // namespace tern
