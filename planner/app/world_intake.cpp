#include "planner/app/world_intake.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "messages/batching.h"
#include "runtime/channels.h"

namespace tern {

WorldIntake::WorldIntake(Bus& bus, const PlannerConfig& config, const UavSpec& uav, bool in_background)
    : config_(config), body_half_(uav.body.half_extents()), flight_box_(uav.flight_box), at_(uav.start) {
  if (in_background) worker_ = std::make_unique<Worker>();
  static_digest_ = digest_of(static_boxes_);
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

void WorldIntake::set_vehicle(const Body& body, const Box& flight_box, const Vec3& at) {
  body_half_ = body.half_extents();
  flight_box_ = flight_box;
  at_ = at;
}

void WorldIntake::on_predictions(const TrackSet& batch) {
  auto set = batches_.add(batch);
  if (!set) return;
  TrackSet whole = join_batches(std::move(*set));
  remember_statics(whole);
  auto products = std::make_shared<const PredictionProducts>(std::move(whole));
  const std::lock_guard lock(mutex_);
  ready_.predictions = std::move(products);
}

/// A set may leave out what is far; a path to the goal needs all that stands. Another predictor starts a new memory.
void WorldIntake::remember_statics(const TrackSet& set) {
  bool changed = false;
  if (set.header.name.sender_epoch_us != statics_epoch_) {
    statics_epoch_ = set.header.name.sender_epoch_us;
    changed = !statics_.empty();
    statics_.clear();
  }
  for (const Track& track : set.tracks) {
    if (track.kind != TrackKind::Static) continue;
    const Box box = track.bounds(track.motion.start, track.motion.start);
    const auto [at, is_new] = statics_.emplace(track.id, box);
    if (is_new || (at->second.min() == box.min() && at->second.max() == box.max())) {
      changed = changed || is_new;
      continue;
    }
    at->second = box;
    changed = true;
  }
  if (!changed) return;
  static_boxes_.clear();
  for (const auto& [id, box] : statics_) static_boxes_.push_back(box);
  static_digest_ = digest_of(static_boxes_);
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
  const GoalFieldKey key{newest_goal_->position, world.map->version, static_digest_, body_half_, flight_box_};
  if (world.goal && world.goal->key == key) {
    const Goal& known = world.goal->goal;
    if (known.id == newest_goal_->id && known.mode == newest_goal_->mode) return;
    const std::lock_guard lock(mutex_);
    ready_.goal = std::make_shared<const GoalProducts>(GoalProducts{*newest_goal_, key, world.goal->field});
    return;
  }
  start([this, goal = *newest_goal_, key, map = world.map, boxes = static_boxes_, at = at_] {
    auto field = std::make_shared<const GoalField>(make_goal_field(key, map->occupied, boxes, at));
    const std::lock_guard lock(mutex_);
    ready_.goal = std::make_shared<const GoalProducts>(GoalProducts{goal, key, std::move(field)});
  });
}

void WorldIntake::make_map(VoxelMap map) {
  auto products = std::make_shared<const MapProducts>(map, config_);
  const std::lock_guard lock(mutex_);
  ready_.map = std::move(products);
}

}  // namespace tern
