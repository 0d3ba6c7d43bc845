#include "campaign/experiments/scenario_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "campaign/experiments/limits_check.h"
#include "core/world/body.h"
#include "core/world/body_distance.h"
#include "core/world/names.h"
#include "executor/executor.h"
#include "planner/app/blocked_goal.h"
#include "planner/app/config_reader.h"
#include "planner/planning_world.h"
#include "predictor/app/predictor_config.h"
#include "runtime/scenario_file.h"
#include "semantic_mapper/app/load_map.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/world_broadcast.h"
#include "simulator/referee/clearance.h"

namespace tern {
namespace {

constexpr double kStep = 0.05;  ///< m, between samples of a path

PlannedPath measured(std::vector<Vec3> points, const std::vector<Region>& regions) {
  PlannedPath way{std::move(points), 0.0, std::vector<double>(regions.size(), 0.0)};
  for (std::size_t k = 1; k < way.points.size(); ++k) {
    const Vec3 from = way.points[k - 1], leg = way.points[k] - from;
    const int samples = std::max(1, static_cast<int>(std::ceil(leg.norm() / kStep)));
    way.length_m += leg.norm();
    for (int i = 0; i < samples; ++i) {
      const Vec3 p = from + leg * ((i + 0.5) / samples);
      for (std::size_t r = 0; r < regions.size(); ++r) {
        if (regions[r].contains(p)) way.in_region_m[r] += leg.norm() / samples;
      }
    }
  }
  return way;
}

/// Returns the path, or the reason in words why there is none. @param body  with its tube
Result<PlannedPath> path_between(const ScenarioView& view, const std::shared_ptr<const MapProducts>& map,
                                 const Body& body) {
  const UavSpec& uav = view.scenario.uav;
  const GoalFieldKey key{uav.goal, map->version, 0, body_box(body), uav.flight_box, way_speed(*map, uav.limits)};
  const std::vector<Box> statics = static_boxes(view.world);
  const GoalField field = make_goal_field(key, map, statics, uav.start);
  auto points = field.path_from(uav.start);
  if (!points) {
    return fail(blocked_goal_text(field, key, statics, uav.start, named_places(view.scenario)));
  }
  return measured(std::move(*points), view.scenario.semantics.regions);
}

std::string place(const Vec3& p) { return fmt::format("({:g}, {:g}, {:g})", p.x(), p.y(), p.z()); }

/// Returns "the occupied voxel at (1.1, 0.1, 0.1) of the map" if the body at the start overlaps one that the planner
/// avoids; "" for none.
std::string voxel_at_the_start(const ScenarioView& view, const VoxelMap& map, const Body& body) {
  const UavSpec& uav = view.scenario.uav;
  const BodyDistance distance(body);
  for (const Box& box : view.occupied) {
    if (distance(uav.start - box.center(), 0.5 * box.sizes()) > -kTouchTolerance) continue;
    const double inside = 1e-3 * map.grid.resolution;
    const Vec3 nearest =
        uav.start.cwiseMax(box.min() + Vec3::Constant(inside)).cwiseMin(box.max() - Vec3::Constant(inside));
    const Eigen::Vector3i cell = map.grid.cell_of(nearest);
    const VoxelLabel label = map.labels[idx(map.grid.index(cell))];
    return fmt::format("the {} voxel at {} of the map", to_string(label), place(map.grid.centre(cell)));
  }
  return "";
}

/// Returns the obstacle in which the body starts, as "obstacle 3 'post'"; "" for none.
std::string around_the_start(const ScenarioView& view, const Body& body) {
  const UavSpec& uav = view.scenario.uav;
  const BodyDistance distance(body);
  for (const WorldObstacle& o : view.world.obstacles) {
    if (!o.present(0.0) || distance(uav.start - o.at(0.0).p, o.half_extents()) > -kTouchTolerance) continue;
    const std::string& name = o.spec().name;
    return fmt::format("obstacle {}{}", o.id(), name.empty() ? "" : fmt::format(" '{}'", name));
  }
  return "";
}

double lambda_of(const Scenario& scenario, const Region& region) {
  const SemanticsSpec& semantics = scenario.semantics;
  for (const auto& [name, lambda] : semantics.lambdas) {
    if (name == region.class_name) return lambda;
  }
  return region_label(scenario, region) == to_string(VoxelLabel::Repulsive) ? semantics.lambda_repulsive
                                                                            : semantics.lambda_attractive;
}

std::string regions_text(const ScenarioView& view) {
  std::string text;
  for (std::size_t r = 0; r < view.scenario.semantics.regions.size(); ++r) {
    const Region& region = view.scenario.semantics.regions[r];
    const std::string& label = region_label(view.scenario, region);
    text += fmt::format("  region    {} ({}, {}", region.name, region.class_name, label);
    const bool weighs = label == to_string(VoxelLabel::Attractive) || label == to_string(VoxelLabel::Repulsive);
    if (weighs) text += fmt::format(", λ {:g}", lambda_of(view.scenario, region));
    text += "), " + region_heights(region);
    if (view.shortest) text += fmt::format(": {:.1f} m of the shortest path", view.shortest->in_region_m[r]);
    if (view.weighted) text += fmt::format(", {:.1f} m of the weighted one", view.weighted->in_region_m[r]);
    text += "\n";
  }
  return text;
}

}  // namespace

const std::string& region_label(const Scenario& scenario, const Region& region) {
  const auto& classes = scenario.semantics.classes;
  return std::ranges::find_if(classes, [&](const auto& c) { return c.first == region.class_name; })->second;
}

std::string world_text(const World& world) {
  std::size_t resting = 0, moving = 0, later = 0;
  for (const WorldObstacle& o : world.obstacles) {
    if (o.present(0.0)) ++(o.moves() ? moving : resting);
    if (o.first_s() > 0.0) ++later;
  }
  const std::string text = fmt::format("{} obstacles: {} rest, {} move", resting + moving, resting, moving);
  return later > 0 ? fmt::format("{}; {} more appear later", text, later) : text;
}

std::string region_heights(const Region& region) {
  const Box box = region.bounds();
  return fmt::format("z {:g} to {:g} m", box.min().z(), box.max().z());
}

ScenarioView view_scenario(const FlightInputs& inputs, std::optional<std::uint64_t> seed) {
  ScenarioView view;
  ConfigDocument document =
      ConfigDocument::load(inputs.scenario_file, seed ? inputs.with_seed(*seed) : inputs.overrides);
  view.scenario = read_scenario(document);
  (void)check_inputs(inputs, view.scenario.seed);
  const auto simulator = read_simulator_config(document.root().section("simulator"), view.scenario.seed);
  view.world = flyable_world_of(view.scenario, simulator);
  LoadedMap loaded = load_map(view.scenario, read_mapper_config(document), std::getenv("TERN_DATA"));
  const VoxelMap& map = loaded.map;
  view.clouds = std::move(loaded.remarks);
  view.warnings = view.world.remarks;
  for (const std::string& warning : excess_thrust(view.scenario.uav.limits, simulator)) {
    view.warnings.push_back(warning);
  }
  PlannerConfig planner = read_planner_config(document.root().section("planner"), view.scenario.semantics);
  const auto weighed = std::make_shared<const MapProducts>(map, planner);
  view.occupied = weighed->occupied.boxes();
  view.map = fmt::format("{} x {} x {} voxels of {:g} m, occupied ones as {} boxes", map.grid.size.x(),
                         map.grid.size.y(), map.grid.size.z(), map.grid.resolution, view.occupied.size());
  planner.semantics = false;
  const double tube_m = document.root().section("executor").read<ExecutorConfig>().tube_m;
  const Body body = grown(view.scenario.uav.body, Vec3::Constant(tube_m));
  const auto shortest = path_between(view, std::make_shared<const MapProducts>(map, planner), body);
  std::string around = around_the_start(view, body);
  if (around.empty()) around = voxel_at_the_start(view, map, body);
  const std::string late = late_sensor(simulator, read_predictor_config(document.root().section("predictor")), planner);
  if (!around.empty() || !shortest || !late.empty()) {
    const std::string tube = tube_m > 0.0 ? fmt::format(", with executor.tube_m {:g} around the body", tube_m) : "";
    view.blocked = !around.empty() ? "the start lies in " + around + tube
                   : !shortest     ? shortest.error().message + tube
                                   : late;
    return view;
  }
  view.shortest = *shortest;
  const auto weighted_path = weighed->semantic_paths ? path_between(view, weighed, body) : shortest;
  if (weighed->semantic_paths && weighted_path) view.weighted = *weighted_path;
  return view;
}

std::string to_text(const ScenarioView& view) {
  const Scenario& s = view.scenario;
  std::string text = fmt::format("{} ({}), seed {}\n", s.name, s.file, s.seed);
  text += fmt::format("  vehicle   from {} to {}, {:.1f} m straight\n", place(s.uav.start), place(s.uav.goal),
                      (s.uav.goal - s.uav.start).norm());
  text += fmt::format("  world     {}\n  map       {}\n", world_text(view.world), view.map);
  for (const MapRemark& remark : view.clouds) {
    text += fmt::format("  {}     {}\n", remark.is_warning ? "WARNING" : "cloud  ", remark.text);
  }
  for (const std::string& warning : view.warnings) text += fmt::format("  WARNING     {}\n", warning);
  text += regions_text(view);
  if (!view.shortest) return text + fmt::format("  goal      cannot be reached: {}\n", view.blocked);
  text += fmt::format("  goal      can be reached: {:.1f} m around static obstacles (moving ones are ignored)\n",
                      view.shortest->length_m);
  if (!view.weighted) return text;
  return text +
         fmt::format("  λ         the weighted path is {:.1f} m, {:+.1f} m; its effect is listed at the regions\n",
                     view.weighted->length_m, view.weighted->length_m - view.shortest->length_m);
}

}  // namespace tern
