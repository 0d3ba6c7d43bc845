#include "planner/app/world_intake.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "messages/batching.h"
#include "runtime/channels.h"

namespace tern {

WorldIntake::WorldIntake(Bus& bus, const PlannerConfig& config, const UavSpec& uav, bool in_background)
    : config_(config), body_half_(uav.body.half_extents()), flight_box_(uav.flight_box), at_(uav.start) {
  if (in_background) worker_ = std::make_unique<Worker>();
  bus.subscribe<TrackSet>(channels::kPredictions, [this](const TrackSet& batch) { on_predictions(batch); });
  bus.subscribe<MapChunk>(channels::kSemanticMap, [this](const MapChunk& chunk) { on_map(chunk); });
  bus.subscribe<Goal>(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
}

PlanningWorld WorldIntake::snapshot() const {
  const std::lock_guard lock(mutex_);
  return ready_;
}

std::string WorldIntake::missing() const {
  const PlanningWorld world = snapshot();
  if (!world.predictions) return "predictions";
  if (!world.map) return pending_map_ ? "the map's fields (being made)" : "a semantic map";
  if (!newest_goal_) return "a goal";
  if (!world.goal) return "the goal's distance field (being made)";
  return "";
}

void WorldIntake::set_vehicle(const HorizonRequest& request) {
  body_half_ = request.body.half_extents();
  flight_box_ = request.flight_box;
  at_ = request.start.p;
  vehicle_ = request.header.name;
}

void WorldIntake::on_predictions(const TrackSet& batch) {
  auto set = batches_.add(batch);
  if (!set) return;
  TrackSet whole = join_batches(std::move(*set));
  statics_.add(whole);
  auto products = std::make_shared<const PredictionProducts>(std::move(whole));
  const std::lock_guard lock(mutex_);
  ready_.predictions = std::move(products);
}

void WorldIntake::on_map(const MapChunk& chunk) {
  const auto complete = assembler_.add(chunk);
  if (!complete) {
    spdlog::warn("semantic map refused: {}", complete.error().message);
    return;
  }
  if (*complete) pending_map_ = assembler_.take();
}

void WorldIntake::on_goal(const Goal& goal) {
  if (newest_goal_ && goal.id < newest_goal_->id) return;
  newest_goal_ = goal;
}

void WorldIntake::start(std::function<void()> job) {
  if (worker_ == nullptr) return job();
  worker_->try_start(std::move(job));
}

void WorldIntake::prepare() {
  if (worker_ != nullptr && worker_->busy()) return;
  if (pending_map_) {
    start([this, map = std::exchange(pending_map_, std::nullopt)]() mutable { make_map(std::move(*map)); });
    if (worker_ != nullptr) return;
  }
  const PlanningWorld world = snapshot();
  if (!newest_goal_ || !world.map || !world.predictions) return;
  const GoalFieldKey key{newest_goal_->position, world.map->version, statics_.digest(), body_half_, flight_box_};
  if (world.goal && world.goal->key == key) {
    const Goal& known = world.goal->goal;
    if (known.id == newest_goal_->id && known.mode == newest_goal_->mode) return;
    const std::lock_guard lock(mutex_);
    ready_.goal = std::make_shared<const GoalProducts>(
        GoalProducts{*newest_goal_, key, world.goal->field, world.goal->made_from});
    return;
  }
  const GoalFieldInputs names{key.map_version, statics_.epoch_us(), statics_.first_set(), key.statics, vehicle_};
  start([this, goal = *newest_goal_, key, names, map = world.map, boxes = statics_.boxes(), at = at_] {
    auto field = std::make_shared<const GoalField>(make_goal_field(key, map, boxes, at));
    const std::lock_guard lock(mutex_);
    ready_.goal = std::make_shared<const GoalProducts>(GoalProducts{goal, key, std::move(field), names});
  });
}

void WorldIntake::make_map(VoxelMap map) {
  auto products = std::make_shared<const MapProducts>(map, config_);
  const std::lock_guard lock(mutex_);
  ready_.map = std::move(products);
}

}  // namespace tern
