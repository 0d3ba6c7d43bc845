#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/digest.h"
#include "core/base/random.h"
#include "core/geometry/box.h"
#include "core/scenario/step_aside.h"
#include "core/wire/message_limits.h"
#include "core/world/body.h"
#include "core/world/names.h"
#include "runtime/fence_reader.h"
#include "runtime/polygon.h"
#include "runtime/scenario_file.h"

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Largest coordinate of a scene, m: doubles there resolve 1e-10 m.
const Range kPosition = Range::within(1e5);
const Range kHalfExtent = Range::positive(1e4);
const Range kSeconds = Range::within(1e6);
const Range kPhase = Range::within(1e4);

/// Longest name, bytes: messages carry no longer ones.
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxClassBytes = 32;
constexpr int kMaxColumns = 100;
constexpr int kMaxCopies = 1'000;
/// Most corners of an outline: the test for crossings takes every pair of edges.
constexpr std::size_t kMaxCorners = 1'000;
static_assert(kMaxExposures * kMaxNameBytes <= kMaxRegionText && kMaxMapClasses * kMaxClassBytes <= kMaxMapClassText);

void check_name(const ConfigSection& section, std::string_view key, const std::string& name, std::size_t most) {
  if (name.size() > most) throw section.error(key, fmt::format("has {} bytes (limit {})", name.size(), most));
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (std::ranges::any_of(name, control)) throw section.error(key, "has a control character");
}

/// Reads a name that must be unique in its list.
std::string unique_name(const ConfigSection& section, std::string name, std::set<std::string>& taken) {
  check_name(section, "name", name, kMaxNameBytes);
  if (!name.empty() && !taken.insert(name).second)
    throw section.error("name", name + " is also the name of another entry");
  return name;
}

Box read_box(ConfigSection section) {
  const Box box{section.required_vec3("min", kPosition), section.required_vec3("max", kPosition)};
  section.finish();
  if (!(box.min().array() < box.max().array()).all())
    throw section.error("max", "must be greater than min on every axis");
  return box;
}

/// Reads the last keys of an obstacle.
WaypointMotion read_waypoints(ConfigSection& section) {
  WaypointMotion motion;
  motion.repeat = section.flag("repeat", motion.repeat);
  motion.vanish = section.flag("vanish", motion.vanish);
  if (motion.vanish) {
    motion.leave_out_within_m = section.number("leave_out_within_m", motion.leave_out_within_m, Range::at_least(0.0));
  }
  const std::vector<std::vector<double>> rows = section.rows("points", 4, kSeconds);
  section.finish();
  for (const std::vector<double>& row : rows) {
    const Vec3 p(row[1], row[2], row[3]);
    const std::size_t index = motion.points.size();
    if (p.cwiseAbs().maxCoeff() > kPosition.high) {
      throw section.error("points", fmt::format("point {} lies farther out than {} m", index, kPosition.high));
    }
    if (index > 0 && row[0] <= motion.points.back().first) {
      throw section.error(
          "points", fmt::format("time {} of point {} is not after {}", row[0], index, motion.points.back().first));
    }
    motion.points.emplace_back(row[0], p);
  }
  if (motion.points.empty()) throw section.error("points", "has no point (at least 1)");
  if (motion.repeat && motion.points.size() < 2) throw section.error("repeat", "true needs at least 2 points");
  if (motion.repeat && motion.points.front().second != motion.points.back().second) {
    throw section.error("repeat", "true requires that the last point equals the first one");
  }
  if (motion.repeat && motion.vanish) throw section.error("vanish", "true cannot be combined with repeat: true");
  return motion;
}

/// Reads the keys of one motion only, so that finish() refuses those of other motions.
void read_motion(ConfigSection& section, ObstacleSpec& obstacle) {
  const std::string motion = section.choice("motion", "static", {"static", "trefoil", "wave", "linear", "waypoints"});
  if (motion == "waypoints") {
    if (section.has("centre")) throw section.error("centre", "is not used by motion waypoints");
    obstacle.motion = read_waypoints(section);
    return;
  }
  obstacle.centre = section.required_vec3("centre", kPosition);
  if (motion == "trefoil") {
    const TrefoilMotion defaults;
    obstacle.motion = TrefoilMotion{section.vec3_or_number("scale", defaults.scale, kPosition),
                                    section.number("slowness", defaults.slowness, Range::positive(1e4)),
                                    section.number("phase", defaults.phase, kPhase)};
  } else if (motion == "wave") {
    const WaveMotion defaults;
    obstacle.motion = WaveMotion{section.required_vec3("amplitude", kPosition),
                                 section.number("slowness", defaults.slowness, Range::positive(1e4)),
                                 section.number("phase", defaults.phase, kPhase)};
  } else if (motion == "linear") {
    obstacle.motion =
        LinearMotion{section.required_vec3("velocity", Range::within(1e3)), section.number("from_s", 0.0, kSeconds)};
  }
}

ObstacleSpec read_obstacle(ConfigSection section, std::set<std::string>& names) {
  ObstacleSpec obstacle;
  obstacle.name = unique_name(section, section.text("name", ""), names);
  obstacle.half_extents = section.vec3_or_number("half_extents", obstacle.half_extents, kHalfExtent);
  read_motion(section, obstacle);
  section.finish();
  return obstacle;
}

/// Reads which parts of the recording are used: as recorded, or copies that the seed scatters.
void read_use(ConfigSection& section, RecordedTracksSpec& spec) {
  spec.copies = static_cast<int>(section.integer("copies", spec.copies, 0, kMaxCopies));
  if (spec.copies > 0) {
    if (!section.has("within")) throw section.error("copies", "needs `within`, the box in which they are");
    spec.within = read_box(section.section("within"));
    return;
  }
  if (section.has("start_s")) {
    spec.start_s = section.required_number("start_s", Range::at_least(0.0));
    spec.wait_for_clear_start = section.flag("wait_for_clear_start", spec.wait_for_clear_start);
  }
  spec.leave_out_within_m = section.number("leave_out_within_m", spec.leave_out_within_m, Range::at_least(0.0));
}

RecordedTracksSpec read_recorded(ConfigSection section) {
  RecordedTracksSpec spec;
  spec.file = section.required_text("file");
  spec.columns = static_cast<int>(section.integer("columns", spec.columns, 4, kMaxColumns));
  std::vector<std::pair<const char*, int>> columns;
  const auto column = [&](const char* key, int fallback, int least = 0) {
    columns.emplace_back(key, static_cast<int>(section.integer(key, fallback, least, kMaxColumns - 1)));
    return columns.back().second;
  };
  spec.id_column = column("id_column", spec.id_column, -1);
  spec.frame_column = column("frame_column", spec.frame_column);
  spec.x_column = column("x_column", spec.x_column);
  spec.y_column = column("y_column", spec.y_column);
  if (const int z_column = column("z_column", spec.z_column.value_or(-1), -1); z_column >= 0) spec.z_column = z_column;
  spec.metres_per_unit = section.number("metres_per_unit", spec.metres_per_unit, Range::positive(1e6));
  spec.frames_per_second = section.number("frames_per_second", spec.frames_per_second, Range::positive(1e9));
  spec.least_step_s = section.number("least_step_s", spec.least_step_s, Range::at_least(0.0, 3600.0));
  spec.half_extents = section.vec3_or_number("half_extents", spec.half_extents, kHalfExtent);
  spec.centre_z = section.number("centre_z", spec.centre_z, kPosition);
  read_use(section, spec);
  section.finish();
  if (spec.file.empty()) throw section.error("file", "must name a file");
  for (std::set<int> used; const auto& [key, c] : columns) {
    if (c >= spec.columns) throw section.error(key, fmt::format("{} is out of range [0, {}]", c, spec.columns - 1));
    if (c < 0 || used.insert(c).second) continue;
    throw section.error(key, fmt::format("column {} is another key's column too", c));
  }
  return spec;
}

WorldSpec read_world(ConfigSection section) {
  WorldSpec world;
  world.generator = section.choice("generator", world.generator, {std::begin(kGenerators), std::end(kGenerators)});
  world.count = static_cast<int>(section.integer("count", world.count, 0, 100'000));
  if (section.has("slowness")) world.slowness = section.required_number("slowness", Range::positive(1e4));
  std::set<std::string> names;
  for (const ConfigSection& entry : section.list("obstacles")) world.obstacles.push_back(read_obstacle(entry, names));
  for (const ConfigSection& entry : section.list("recorded")) world.recorded.push_back(read_recorded(entry));
  read_origin_and_fences(section, world);
  section.finish();
  if (world.generator == "none" && world.count > 0) {
    throw section.error("count", fmt::format("{} needs world.generator, which is none", world.count));
  }
  if (world.generator == "step_aside" && world.count > 0) {
    throw section.error("count", fmt::format("{}: the generator step_aside draws the count itself", world.count));
  }
  return world;
}

Body read_body(ConfigSection section, Body body) {
  const int shapes =
      (section.has("radius") ? 1 : 0) + (section.has("half_extents") ? 1 : 0) + (section.has("vertices") ? 1 : 0);
  if (shapes > 1) throw section.error("radius", "give one of radius, half_extents, vertices");
  if (section.has("half_extents")) {
    const Vec3 half = section.required_vec3("half_extents", Range::positive(100.0));
    body.vertices = box_corners(Box(-half, half));
    body.radius = 0.0;
  } else if (section.has("vertices")) {
    const auto rows = section.rows("vertices", 3, Range::within(100.0));
    if (rows.empty() || rows.size() > kMaxBodyVertices) {
      throw section.error("vertices", fmt::format("{} vertices (limit 1 to {})", rows.size(), kMaxBodyVertices));
    }
    body.vertices.resize(3, static_cast<Eigen::Index>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) {
      body.vertices.col(static_cast<Eigen::Index>(k)) = Vec3(rows[k][0], rows[k][1], rows[k][2]);
    }
    body.radius = 0.0;
  } else {
    body.radius = section.number("radius", body.radius, Range::at_least(0.0, 100.0));
  }
  section.finish();
  return body;
}

using Route = std::pair<Vec3, Vec3>;
/// Reads start and goal, in the order of braces: digests depend on it. Of several routes the seed draws one.
Route read_route(ConfigSection& section, const UavSpec& uav, std::uint64_t seed, std::vector<Route>& routes) {
  for (ConfigSection entry : section.list("routes")) {
    routes.push_back({entry.required_vec3("from", kPosition), entry.required_vec3("to", kPosition)});
    entry.finish();
  }
  if (routes.empty())
    return routes.emplace_back(
        Route{section.vec3("start", uav.start, kPosition), section.vec3("goal", uav.goal, kPosition)});
  if (section.has("start") || section.has("goal")) {
    throw section.error("routes", "cannot be combined with uav.start or uav.goal: each route has both");
  }
  Rng rng(digest("uav.routes", seed));
  Route route = routes[static_cast<std::size_t>(rng.uniform() * static_cast<double>(routes.size()))];
  if (rng.uniform() < 0.5) std::swap(route.first, route.second);
  return route;
}

/// @param uav  defaults of the section
UavSpec read_uav(ConfigSection section, UavSpec uav, std::uint64_t seed) {
  std::vector<Route> routes;
  std::tie(uav.start, uav.goal) = read_route(section, uav, seed, routes);
  ConfigSection limits = section.section("limits");
  uav.limits.v_max = limits.vec3_or_number("v_max", uav.limits.v_max, Range::at_least(kMinLimit, kMaxSpeedLimit));
  uav.limits.a_max =
      limits.vec3_or_number("a_max", uav.limits.a_max, Range::at_least(kMinLimit, kMaxAccelerationLimit));
  uav.limits.j_max = limits.vec3_or_number("j_max", uav.limits.j_max, Range::at_least(kMinLimit, kInfinity));
  limits.finish();
  if (section.has("dynamics")) section.section("dynamics").read(uav.limits.dynamics.emplace());
  uav.body = read_body(section.section("body"), uav.body);
  section.section("heading").read(uav.heading);
  if (section.has("flight_box")) uav.flight_box = read_box(section.section("flight_box"));
  section.finish();
  const Box places = places_within(uav.flight_box, body_box(uav.body));
  const auto check = [&, low = places.min(), high = places.max()](const char* key, const Vec3& p) {
    if (places.contains(p)) return;
    throw section.error(
        key, fmt::format("[{}, {}, {}]{} is outside the flight box, body included (limits [{}, {}, {}] to "
                         "[{}, {}, {}])",
                         p.x(), p.y(), p.z(), section.has(key) ? "" : ", its default,", low.x(), low.y(), low.z(),
                         high.x(), high.y(), high.z()));
  };
  for (const auto& [from, to] : routes) {
    check(section.has("routes") ? "routes" : "start", from);
    check(section.has("routes") ? "routes" : "goal", to);
  }
  return uav;
}

/// The generator step_aside also draws the vehicle.
UavSpec default_uav(const Scenario& scenario) {
  UavSpec uav;
  if (scenario.world.generator != "step_aside") return uav;
  StepAside drawn = draw_step_aside(scenario.seed, uav.start);
  std::tie(uav.limits, uav.body) = std::tie(drawn.limits, drawn.body);
  return uav;
}

PrismRegion read_prism(ConfigSection section) {
  PrismRegion prism;
  for (const std::vector<double>& row : section.rows("corners", 2, kPosition))
    prism.corners.emplace_back(row[0], row[1]);
  prism.z_min = section.required_number("z_min", kPosition);
  prism.z_max = section.required_number("z_max", kPosition);
  section.finish();
  if (prism.corners.size() < 3)
    throw section.error("corners", fmt::format("{} corners (at least 3)", prism.corners.size()));
  if (prism.corners.size() > kMaxCorners)
    throw section.error("corners", fmt::format("{} of them (limit {})", prism.corners.size(), kMaxCorners));
  if (!is_simple_polygon(prism.corners)) throw section.error("corners", "the polygon touches or crosses itself");
  if (prism.z_min >= prism.z_max) throw section.error("z_max", "must be greater than z_min");
  return prism;
}

BallRegion read_ball(ConfigSection section) {
  BallRegion ball{section.required_vec3("centre", kPosition), section.required_number("radius", kHalfExtent)};
  section.finish();
  return ball;
}

Region read_region(ConfigSection section, std::set<std::string>& names) {
  Region region;
  region.name = unique_name(section, section.required_text("name"), names);
  if (region.name.empty()) throw section.error("name", "must not be empty");
  region.class_name = section.required_text("class");
  const int shapes = (section.has("box") ? 1 : 0) + (section.has("ball") ? 1 : 0) + (section.has("prism") ? 1 : 0);
  if (shapes != 1) {
    section.finish();
    throw section.error("name", fmt::format("{} shapes (give one of box, ball, prism)", shapes));
  }
  if (section.has("box")) {
    region.shape = read_box(section.section("box"));
  } else if (section.has("ball")) {
    region.shape = read_ball(section.section("ball"));
  } else {
    region.shape = read_prism(section.section("prism"));
  }
  section.finish();
  return region;
}

/// Reads class → label; without the key, the default table, which then is part of the effective configuration.
decltype(SemanticsSpec::classes) read_classes(ConfigSection classes, bool is_given) {
  const std::vector<std::string> labels(kWords<VoxelLabel>.begin(), kWords<VoxelLabel>.end());
  decltype(SemanticsSpec::classes) result;
  if (!is_given) {
    for (const auto& [name, label] : SemanticsSpec{}.classes)
      result.emplace_back(name, classes.choice(name, label, labels));
  }
  const std::vector<std::string> given = classes.keys();
  // The map's class 0 is "none".
  if (given.size() >= kMaxMapClasses) {
    throw classes.error(given.back(), fmt::format("{} classes (limit {})", given.size(), kMaxMapClasses - 1));
  }
  for (const std::string& name : given) {
    check_name(classes, name, name, kMaxClassBytes);
    result.emplace_back(name, classes.choice(name, "", labels));
  }
  return result;
}

/// Reads class → λ.
decltype(SemanticsSpec::lambdas) read_lambdas(ConfigSection lambdas) {
  decltype(SemanticsSpec::lambdas) result;
  const std::vector<std::string> given = lambdas.keys();
  if (given.size() >= kMaxMapClasses) {
    throw lambdas.error(given.back(), fmt::format("{} classes (limit {})", given.size(), kMaxMapClasses - 1));
  }
  for (const std::string& name : given) {
    result.emplace_back(name, lambdas.required_number(name, Range::at_least(0.0, 1e6)));
  }
  return result;
}

SemanticsSpec read_semantics(ConfigSection section) {
  SemanticsSpec semantics;
  semantics.enabled = section.flag("enabled", semantics.enabled);
  semantics.lambda_attractive =
      section.number("lambda_attractive", semantics.lambda_attractive, Range::at_least(0.0, 1e6));
  semantics.lambda_repulsive =
      section.number("lambda_repulsive", semantics.lambda_repulsive, Range::at_least(0.0, 1e6));
  semantics.cost = section.choice("cost", semantics.cost, {"exposure", "mean_distance"});
  semantics.classes = read_classes(section.section("classes"), section.has("classes"));
  ConfigSection lambdas = section.section("lambdas");
  semantics.lambdas = read_lambdas(lambdas);
  const std::vector<ConfigSection> regions = section.list("regions");
  if (regions.size() > kMaxExposures) {
    throw section.error("regions", fmt::format("{} of them (limit {})", regions.size(), kMaxExposures));
  }
  std::set<std::string> names;
  for (const ConfigSection& entry : regions) semantics.regions.push_back(read_region(entry, names));
  section.finish();
  const auto is_class = [&](const std::string& name) {
    return std::ranges::any_of(semantics.classes, [&](const auto& c) { return c.first == name; });
  };
  for (const auto& [name, lambda] : semantics.lambdas) {
    if (!is_class(name)) throw lambdas.error(name, "is not one of semantics.classes");
  }
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const std::string& name = semantics.regions[k].class_name;
    if (!is_class(name)) throw regions[k].error("class", fmt::format("{} is not one of semantics.classes", name));
  }
  return semantics;
}

}  // namespace

Scenario read_scenario(ConfigDocument& document) {
  ConfigSection root = document.root();
  Scenario scenario;
  scenario.file = document.file();
  scenario.name = root.text("name", std::filesystem::path(document.file()).stem().string());
  check_name(root, "name", scenario.name, kMaxNameBytes);
  scenario.seed = static_cast<std::uint64_t>(root.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  if (root.has("timeout_s")) scenario.timeout_s = root.required_number("timeout_s", Range::positive(1e6));
  scenario.world = read_world(root.section("world"));
  scenario.uav = read_uav(root.section("uav"), default_uav(scenario), scenario.seed);
  scenario.semantics = read_semantics(root.section("semantics"));
  for (const char* section : kProcessSections) root.ignore(section);
  root.finish();
  return scenario;
}

}  // namespace tern
