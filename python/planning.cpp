#include "python/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/world/body.h"
#include "planner/app/config_reader.h"
#include "planner/plan_workspace.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"

namespace tern::python {
namespace {

/// The executor sends requests this long before t_s.
constexpr Duration kRequestLead{75'000};

std::shared_ptr<const GoalProducts> goal_of(const Goal& goal, GoalFieldKey key,
                                            const std::shared_ptr<const MapProducts>& map, const StaticTracks& statics,
                                            const Vec3& start) {
  key.statics = statics.digest();
  GoalProducts products{goal, key, nullptr, {}};
  products.field = std::make_shared<const GoalField>(make_goal_field(key, map, statics.boxes(), start));
  products.made_from.map_version = map->version;
  products.made_from.statics = key.statics;
  return std::make_shared<const GoalProducts>(std::move(products));
}

StaticTracks statics_of(const TrackSet& tracks) {
  StaticTracks statics;
  statics.add(tracks);
  return statics;
}

}  // namespace

HorizonRequest request_of(const Vehicle& vehicle, const TimedSpline& committed, UTime t_s, std::int64_t id) {
  HorizonRequest request;
  request.header.name = {1, id};
  request.header.utime = t_s - kRequestLead;
  request.id = id;
  request.t_s = t_s;
  request.deadline = t_s - kDeadlineLead;
  request.committed = committed;
  if (t_s < committed.start) {
    throw std::invalid_argument(
        fmt::format("t_s_us {} is before the committed trajectory's start, {}", t_s.us, committed.start.us));
  }
  if (!committed.spline().ends_at_rest()) {
    throw std::invalid_argument("committed: does not end at rest; its last three control points must be equal");
  }
  request.start = committed.sample(t_s);
  request.limits = vehicle.limits;
  request.body = vehicle.body;
  request.flight_box = vehicle.flight_box;
  request.tube = vehicle.tube;
  require_acceptable(request, "request");
  return request;
}

TrackSet track_set_of(std::vector<Track> tracks, UTime made_at, double confidence) {
  TrackSet set;
  set.header.name = {2, 1};
  set.header.utime = set.made_at = made_at;
  set.batch.set = 1;
  set.confidence = confidence;
  require_acceptable(set, "tracks");
  std::ranges::stable_sort(tracks, {}, &Track::id);
  TrackSet one = set;
  for (std::size_t k = 0; k < tracks.size(); ++k) {
    const std::string what = fmt::format("track {}", tracks[k].id);
    if (k > 0 && tracks[k].id == tracks[k - 1].id) throw std::invalid_argument(what + " is given twice");
    one.tracks = {tracks[k]};
    require_acceptable(one, what);
  }
  set.tracks = std::move(tracks);
  return set;
}

VoxelMap checked_map(VoxelMap map) {
  const auto voxels = static_cast<std::size_t>(map.grid.voxels());
  if (map.grid.voxels() > kMaxVoxels) {
    throw std::invalid_argument(fmt::format("labels: {} voxels, more than {}", voxels, kMaxVoxels));
  }
  if (map.labels.size() != voxels || map.classes.size() != voxels) {
    throw std::invalid_argument("labels and classes must have the grid's shape");
  }
  const auto label = std::ranges::max_element(map.labels);
  if (label != map.labels.end() && idx(*label) >= kVoxelLabels) {
    throw std::invalid_argument(fmt::format("labels: {} is no label; they are 0 to {}", idx(*label), kVoxelLabels - 1));
  }
  const auto highest = std::ranges::max_element(map.classes);
  if (highest != map.classes.end() && *highest >= map.class_names.size()) {
    throw std::invalid_argument(fmt::format("classes: {} has no name; there are {}", *highest, map.class_names.size()));
  }
  map.version = map.compute_version();
  MapChunk chunk = to_chunks(map).front();
  chunk.header.name = {1, 1};
  require_acceptable(chunk, "map");
  return map;
}

PlannerConfig planner_config_of(const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    if (setting.starts_with("planner.") || setting.starts_with("semantics.")) continue;
    throw ConfigError(setting + ": a planner has the settings planner.… and semantics.…");
  }
  ConfigDocument document = ConfigDocument::parse("", "settings", settings);
  const Scenario scenario = read_scenario(document);
  return read_planner_config(document.root().section("planner"), scenario.semantics);
}

PreparedWorld::PreparedWorld(const Vehicle& vehicle, const Vec3& goal, const Vec3& start, TrackSet tracks,
                             const VoxelMap& map, PlannerConfig config)
    : config_(std::move(config)), start_(start) {
  Goal told;
  told.header.name = {3, 1};
  told.id = 1;
  told.position = goal;
  require_acceptable(told, "goal");
  const StaticTracks statics = statics_of(tracks);
  world_.predictions = std::make_shared<const PredictionProducts>(std::move(tracks));
  world_.map = std::make_shared<const MapProducts>(map, config_);
  GoalFieldKey key;
  key.goal = goal;
  key.map_version = map.version;
  key.body = body_box(grown(vehicle.body, vehicle.tube));
  key.flight_box = vehicle.flight_box;
  key.speed = way_speed(*world_.map, vehicle.limits);
  world_.goal = goal_of(told, key, world_.map, statics, start);
}

PreparedWorld PreparedWorld::with_tracks(TrackSet tracks) const {
  PlanningWorld world = world_;
  const StaticTracks statics = statics_of(tracks);
  world.predictions = std::make_shared<const PredictionProducts>(std::move(tracks));
  if (world.goal && world.goal->field && world.map && world.goal->key.statics != statics.digest()) {
    world.goal = goal_of(world.goal->goal, world.goal->key, world.map, statics, start_);
  }
  return {std::move(world), config_, start_};
}

Answer answer_of(const HorizonRequest& request, const PreparedWorld& world,
                 const std::optional<std::vector<BudgetCut>>& cuts) {
  static thread_local PlanWorkspace workspace;
  Budget budget = cuts ? Budget::replay(*cuts) : Budget::unlimited();
  PlanAnswer answer = plan(request, world.world(), world.config(), budget, workspace);
  return {std::move(answer.plan), answer.statistics};
}

}  // namespace tern::python
