#include "campaign/experiments/ways_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/base/random.h"
#include "planner/planning_world.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

const Vec3 kStart(-5, 0, 1), kGoal(75, 0, 1);
const Box kFlightBox(Vec3(-10, -25, 0.6), Vec3(80, 25, 4.0));
constexpr double kVoxel = 0.5, kHigh = 4.0;  ///< side of a voxel, height of the regions, m

/// A region and its label in truth.
struct Patch {
  Box box;
  bool is_water = false;
};

struct DrawnWorld {
  WaysFamily family = WaysFamily::Lake;
  double ground = 1.0;  ///< landmarks per m², as the planner knows
  std::vector<Patch> patches;
};

Patch patch(double x0, double y0, double x1, double y1, bool is_water) {
  return {Box(Vec3(x0, y0, 0.0), Vec3(x1, y1, kHigh)), is_water};
}

/// A patch about a place on the way, this large along it and across it.
Patch patch_at(Rng& rng, double length, double width, bool is_water) {
  const double x = rng.uniform(10.0, 60.0), y = rng.uniform(-12.0, 12.0);
  return patch(x - 0.5 * length, y - 0.5 * width, x + 0.5 * length, y + 0.5 * width, is_water);
}

void draw_lakes(Rng& rng, DrawnWorld& world) {
  const int lakes = rng.uniform() < 0.5 ? 1 : 2;
  for (int k = 0; k < lakes; ++k) {
    const double length = rng.uniform(10.0, lakes == 1 ? 50.0 : 22.0), width = rng.uniform(6.0, 18.0);
    const double x = 8.0 + 32.0 * k + rng.uniform(0.0, 6.0), y = rng.uniform(-5.0, 5.0);
    world.patches.push_back(patch(x, y - 0.5 * width, x + length, y + 0.5 * width, true));
  }
}

void draw_walls(Rng& rng, DrawnWorld& world) {
  world.ground = 0.03;
  for (int k = 0; k < 2; ++k) {
    const double x = rng.uniform(0.0, 40.0), side = k == 0 ? 1.0 : -1.0, y = side * rng.uniform(4.0, 16.0);
    world.patches.push_back(patch(x, y - 1.0, x + rng.uniform(10.0, 35.0), y + 1.0, false));
  }
}

void draw_facade(Rng& rng, DrawnWorld& world) {
  world.ground = 0.1;
  const double x = rng.uniform(0.0, 30.0), y = rng.uniform(5.0, 15.0) * (rng.uniform() < 0.5 ? 1.0 : -1.0);
  world.patches.push_back(patch(x, y - 1.0, x + rng.uniform(20.0, 45.0), y + 1.0, false));
}

/// A river across the way, of three parts: between them is a bridge or a ford.
void draw_river(Rng& rng, DrawnWorld& world) {
  const double x = rng.uniform(15.0, 30.0), width = rng.uniform(10.0, 30.0);
  const double gap = rng.uniform(4.0, 8.0), at = rng.uniform(-15.0, 15.0);
  world.patches.push_back(patch(x, -25.0, x + width, at - 0.5 * gap, true));
  world.patches.push_back(patch(x, at + 0.5 * gap, x + width, 25.0, true));
  world.patches.push_back(patch(x, at - 0.5 * gap, x + width, at + 0.5 * gap, false));
}

DrawnWorld drawn_world(Rng& rng, WaysFamily family) {
  DrawnWorld world;
  world.family = family;
  switch (family) {
    case WaysFamily::Lake: draw_lakes(rng, world); break;
    case WaysFamily::Hall: draw_walls(rng, world); break;
    case WaysFamily::Facade: draw_facade(rng, world); break;
    case WaysFamily::River: draw_river(rng, world); break;
    case WaysFamily::Patches:
      world.ground = 0.3;
      for (int k = 0; k < 10; ++k) {
        world.patches.push_back(patch_at(rng, rng.uniform(4.0, 14.0), rng.uniform(3.0, 10.0), rng.uniform() < 0.5));
      }
      break;
  }
  return world;
}

VoxelMap map_of(const DrawnWorld& world) {
  VoxelMap map;
  map.grid.origin = Vec3(-10, -25, 0);
  map.grid.resolution = kVoxel;
  map.grid.size = {180, 100, 8};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {"", "water", "texture"};
  for (std::int64_t i = 0; i < map.grid.voxels(); ++i) {
    const Vec3 p = map.grid.centre(map.grid.cell(i));
    const auto in = std::ranges::find_if(world.patches, [&](const Patch& patch) { return patch.box.contains(p); });
    if (in == world.patches.end()) continue;
    map.labels[static_cast<std::size_t>(i)] = in->is_water ? VoxelLabel::Repulsive : VoxelLabel::Attractive;
    map.classes[static_cast<std::size_t>(i)] = in->is_water ? 1 : 2;
  }
  map.version = map.compute_version();
  return map;
}

PlannerConfig config_of(WayChooser chooser, double ground, double price) {
  PlannerConfig config;
  config.semantics = chooser != WayChooser::Shortest;
  config.lambda_attractive = config.lambda_repulsive = chooser == WayChooser::Exposure03 ? 0.3 : 2.0;
  config.error_price.landmarks.ground = ground;
  if (chooser == WayChooser::Price || chooser == WayChooser::Oracle) config.error_price.error_price = price;
  return config;
}

Limits limits() {
  Limits limits;
  limits.v_max = Vec3::Constant(6.0);
  return limits;
}

GoalField field_of(const DrawnWorld& labels, WayChooser chooser, double price) {
  const auto map = std::make_shared<const MapProducts>(map_of(labels), config_of(chooser, labels.ground, price));
  const Box body = box_around(Vec3::Zero(), Vec3::Constant(0.2));
  const GoalFieldKey key{kGoal, map->version, 0, body, kFlightBox, way_speed(*map, limits())};
  return make_goal_field(key, map, {}, kStart);
}

double length_of(const std::vector<Vec3>& path) {
  double length = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
  return length;
}

}  // namespace

const char* to_string(WaysFamily family) {
  switch (family) {
    case WaysFamily::Lake: return "lake";
    case WaysFamily::Hall: return "hall";
    case WaysFamily::Facade: return "facade";
    case WaysFamily::River: return "river";
    case WaysFamily::Patches: return "patches";
  }
  return "?";
}

const char* to_string(WayChooser chooser) {
  switch (chooser) {
    case WayChooser::Shortest: return "shortest";
    case WayChooser::Exposure2: return "λ = 2";
    case WayChooser::Exposure03: return "λ = 0.3";
    case WayChooser::Price: return "error price";
    case WayChooser::Oracle: return "oracle";
  }
  return "?";
}

std::vector<ChosenWay> choose_ways(const WaysOptions& options) {
  std::vector<ChosenWay> ways;
  for (int k = 0; k < options.worlds; ++k) {
    Rng rng(options.seed + static_cast<std::uint64_t>(k));
    const DrawnWorld truth = drawn_world(rng, static_cast<WaysFamily>(k % kWaysFamilies));
    DrawnWorld labelled = truth;
    ChosenWay way{.world = k, .family = truth.family, .regions = static_cast<int>(truth.patches.size())};
    for (Patch& patch : labelled.patches) {
      if (rng.uniform() >= options.wrong_share) continue;
      patch.is_water = !patch.is_water;
      ++way.wrong_labels;
    }
    const GoalField oracle = field_of(truth, WayChooser::Oracle, options.price);
    const double speed = kCruiseShare * 6.0;
    for (int c = 0; c < kWayChoosers; ++c) {
      way.chooser = static_cast<WayChooser>(c);
      const auto path = way.chooser == WayChooser::Oracle
                            ? oracle.path_from(kStart)
                            : field_of(labelled, way.chooser, options.price).path_from(kStart);
      if (!path) throw std::logic_error("a drawn world has no way");
      const ForetoldError error = foretell_error(*path, speed, *oracle.cost().information);
      way.way_m = length_of(*path);
      way.sigma_goal_m = error.at_goal;
      way.sigma_worst_m = error.at_worst;
      way.cost_m = way.way_m + options.price * (error.at_goal + error.at_worst);
      ways.push_back(way);
    }
  }
  return ways;
}

MeanInterval regret(const std::vector<ChosenWay>& ways, WayChooser chooser, int family) {
  std::vector<double> shares;
  for (std::size_t k = 0; k < ways.size(); k += kWayChoosers) {
    if (family >= 0 && static_cast<int>(ways[k].family) != family) continue;
    const double best = ways[k + static_cast<std::size_t>(WayChooser::Oracle)].cost_m;
    shares.push_back(ways[k + static_cast<std::size_t>(chooser)].cost_m / best - 1.0);
  }
  return mean_interval(shares);
}

std::string to_csv(const std::vector<ChosenWay>& ways) {
  std::string csv = "world,family,regions,wrong_labels,chooser,way_m,sigma_goal_m,sigma_worst_m,cost_m\n";
  for (const ChosenWay& way : ways) {
    csv += fmt::format("{},{},{},{},{},{:.3f},{:.4f},{:.4f},{:.3f}\n", way.world, to_string(way.family), way.regions,
                       way.wrong_labels, to_string(way.chooser), way.way_m, way.sigma_goal_m, way.sigma_worst_m,
                       way.cost_m);
  }
  return csv;
}

std::string to_markdown(const std::vector<ChosenWay>& ways) {
  std::string table = "| ways by | all | lake | hall | facade | river | patches |\n|---|---|---|---|---|---|---|\n";
  for (int c = 0; c < kWayChoosers - 1; ++c) {
    table += fmt::format("| {} |", to_string(static_cast<WayChooser>(c)));
    for (int family = -1; family < kWaysFamilies; ++family) {
      const MeanInterval share = regret(ways, static_cast<WayChooser>(c), family);
      table += fmt::format(" {:.1f} ± {:.1f} % |", 100.0 * share.mean, 100.0 * share.half);
    }
    table += "\n";
  }
  return table;
}

}  // namespace tern
