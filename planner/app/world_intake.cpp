#include "planner/app/world_intake.h"

#include <fmt/format.h>

#include <utility>

#include "core/world/body.h"
#include "messages/batching.h"
#include "messages/channels.h"
#include "runtime/log.h"

namespace tern {

WorldIntake::WorldIntake(Bus& bus, const PlannerConfig& config, const UavSpec& uav, bool in_background,
                         std::vector<NamedPlace> places)
    : bus_(bus),
      config_(config),
      places_(std::move(places)),
      body_(body_box(uav.body)),
      flight_box_(uav.flight_box),
      limits_(uav.limits),
      position_(uav.start) {
  if (in_background) worker_ = std::make_unique<Worker>();
  bus.subscribe(channels::kPoseError, [this](const PoseError& error) { pose_errors_.add(error); });
  bus.subscribe(channels::kPredictions, [this](const TrackSet& batch) { on_predictions(batch); });
  bus.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) { on_map(chunk); });
  bus.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  if (!config.semantics || !config.error_price.learn_densities || !(config.error_price.error_price > 0.0)) return;
  densities_.emplace();
  bus.subscribe(channels::kFeatureTracks, [this](const FeatureFrame& frame) { densities_->add(frame); });
  bus.subscribe(channels::kOdometry, [this](const Odometry& odometry) { on_odometry(odometry); });
}

PlanningWorld WorldIntake::snapshot() const {
  const std::lock_guard lock(mutex_);
  return ready_;
}

std::string WorldIntake::missing() const {
  const PlanningWorld world = snapshot();
  if (!world.predictions) return "predictions";
  if (!world.map) return map_progress_.is_complete() ? "the map's fields (in preparation)" : map_progress_.missing();
  if (!newest_goal_) return "a goal";
  if (!world.goal) return "the goal's distance field (in preparation)";
  return "";
}

std::string WorldIntake::blocked() const {
  const std::lock_guard lock(mutex_);
  return blocked_;
}

void WorldIntake::set_vehicle(const HorizonRequest& request) {
  const std::int64_t epoch_us = request.header.name.sender_epoch_us;
  if (vehicle_ != MessageName{} && epoch_us != vehicle_.sender_epoch_us) forget_before(epoch_us);
  body_ = body_box(grown(request.body, request.tube));
  flight_box_ = request.flight_box;
  limits_ = request.limits;
  position_ = request.start.p;
  vehicle_ = request.header.name;
  repeat_densities(bus_.clock().now());
}

void WorldIntake::forget_before(std::int64_t epoch_us) {
  log::info("requests come from another vehicle: the previous vehicle's goal and static obstacles are discarded");
  statics_ = StaticTracks();
  if (densities_) densities_.emplace();
  if (const auto predictions = snapshot().predictions) statics_.add(predictions->set);
  const auto is_of_this_flight = [&](const std::optional<Goal>& goal) {
    return goal && (goal->header.name.sender_epoch_us == epoch_us || goal->header.utime.us > epoch_us);
  };
  if (is_of_this_flight(newest_goal_)) return;
  newest_goal_ = is_of_this_flight(other_goal_) ? other_goal_ : std::nullopt;
  publish(++goal_number_, nullptr);
  publish_goal_to_hold();
}

void WorldIntake::on_predictions(const TrackSet& batch) {
  auto set = batches_.add(batch);
  if (!set) return;
  TrackSet whole = join_batches(std::move(*set));
  if (!pose_errors_.add_to(whole)) return bus_.refuse(channels::kPredictions, Rejection::Inconsistent);
  statics_.add(whole);
  auto products = std::make_shared<const PredictionProducts>(std::move(whole));
  const std::lock_guard lock(mutex_);
  ready_.predictions = std::move(products);
}

void WorldIntake::on_map(const MapChunk& chunk) {
  const auto complete = assembler_.add(chunk);
  if (!complete) {
    log::warn("semantic map refused: {}", complete.error().message);
    return;
  }
  map_progress_.add(chunk);
  if (*complete) pending_map_ = assembler_.take();
}

void WorldIntake::on_goal(const Goal& goal) {
  const UTime now = bus_.received();
  const bool is_vehicles = goal.header.name.sender_epoch_us == vehicle_.sender_epoch_us;
  const bool is_kept_by_vehicle = is_vehicles && now - goal_received_ > kGoalTaken;
  const bool is_conflicting = newest_goal_ && goal.id == newest_goal_->id && !same_goal(goal, *newest_goal_);
  if (newest_goal_ && (goal.id < newest_goal_->id || is_conflicting) && !is_kept_by_vehicle) {
    if (is_conflicting) bus_.refuse(channels::kGoal, Rejection::Inconsistent);
    other_goal_ = goal;
    return;
  }
  const bool is_repeated = newest_goal_ && goal.id == newest_goal_->id && same_goal(goal, *newest_goal_);
  if (!is_repeated) goal_received_ = now;
  newest_goal_ = goal;
  ++goal_number_;
  publish_goal_to_hold();
}

/// Keeps the distance field of the previous goal, in case that becomes the goal again.
void WorldIntake::publish_goal_to_hold() {
  if (!newest_goal_ || newest_goal_->mode == GoalMode::Go) return;
  const auto known = snapshot().goal;
  GoalProducts products = known ? *known : GoalProducts();
  products.goal = *newest_goal_;
  publish(goal_number_, std::make_shared<const GoalProducts>(std::move(products)));
}

/// A product for an older goal that is ready after one for a newer goal is dropped.
void WorldIntake::publish(std::int64_t number, std::shared_ptr<const GoalProducts> goal,
                          std::optional<KeptField> made) {
  const std::lock_guard lock(mutex_);
  if (number < ready_number_) return;
  ready_number_ = number;
  ready_.goal = std::move(goal);
  if (made) kept_ = std::move(*made);
}

void WorldIntake::note_blocked(std::string blocked) {
  const std::lock_guard lock(mutex_);
  if (!blocked.empty() && blocked != blocked_) log::warn("{}", blocked);
  blocked_ = std::move(blocked);
}

void WorldIntake::start(std::function<void()> job) {
  if (worker_ == nullptr) return job();
  worker_->try_start(std::move(job));
}

void WorldIntake::prepare() {
  if (worker_ != nullptr && worker_->busy()) return;
  if (pending_map_) {
    start([this, map = std::exchange(pending_map_, std::nullopt)] { make_map(*map); });
    if (worker_ != nullptr) return;
  }
  const PlanningWorld world = snapshot();
  if (!newest_goal_ || newest_goal_->mode != GoalMode::Go || !world.map || !world.predictions) return;
  const GoalFieldKey key = key_now(*world.map);
  if (world.goal && world.goal->field && still_serves(*world.goal, key)) {
    // A repeated goal is published by its new name: plans then name a message that a late logger has received.
    if (world.goal->goal.header.name == newest_goal_->header.name) return;
    return publish(goal_number_, std::make_shared<const GoalProducts>(GoalProducts{
                                     *newest_goal_, world.goal->key, world.goal->field, world.goal->made_from}));
  }
  const GoalFieldInputs names = names_of(key);
  const bool is_new = !world.goal || world.goal->goal.id != newest_goal_->id;
  start([this, is_new, number = goal_number_, goal = *newest_goal_, key, names, map = world.map,
         obstacles = statics_.obstacles(), at = position_] {
    const KeptField made = make_kept_field(key, map, obstacles, at);
    const auto& field = made.field;
    std::string blocked;
    if (!field->path_from(at)) {
      blocked = fmt::format("goal {} is blocked: {}", goal.id,
                            blocked_goal_text(*field, made.key, made.static_boxes, at, places_));
    }
    note_blocked(std::move(blocked));
    if (const auto error = is_new ? foretell_error(*field, at, key.speed) : std::nullopt) {
      log::info("error of the position foretold for goal {}: σ {:.2f} m there, {:.2f} m at the worst place", goal.id,
                error->at_goal, error->at_worst);
    }
    publish(number, std::make_shared<const GoalProducts>(GoalProducts{goal, made.key, field, names}), made);
  });
}

GoalFieldKey WorldIntake::key_now(const MapProducts& map) const {
  return {newest_goal_->position,
          map.version,
          statics_.digest(),
          body_,
          flight_box_,
          way_speed(map, limits_),
          statics_.obstacles().map_margin,
          densities_ ? densities_->densities_for(map) : std::nullopt};
}

/// Names the inputs of a field, and announces its densities if they are not those of the labels.
GoalFieldInputs WorldIntake::names_of(const GoalFieldKey& key) {
  GoalFieldInputs names{key.map_version, statics_.epoch_us(), statics_.first_set(), key.statics, vehicle_};
  announced_.reset();
  if (!key.densities) return names;
  announced_ = LandmarkDensities{{}, 0, key.statics, key.map_version, *key.densities};
  announced_->statics = names.statics = name_of(*announced_);
  announced_at_ = bus_.clock().now();
  bus_.publish(channels::kLandmarkDensities, *announced_);
  return names;
}

void WorldIntake::repeat_densities(UTime now) {
  if (!announced_ || now - announced_at_ < kDensitiesRepeated) return;
  announced_at_ = now;
  bus_.publish(channels::kLandmarkDensities, *announced_);
}

void WorldIntake::on_odometry(const Odometry& odometry) {
  const PlanningWorld world = snapshot();
  if (!world.map) return;
  for (const std::string& line : densities_->add(odometry, *world.map, world.predictions.get(), statics_.obstacles())) {
    log::info("{}", line);
  }
}

bool WorldIntake::still_serves(const GoalProducts& goal, const GoalFieldKey& key) const {
  const std::lock_guard lock(mutex_);
  return goal.field == kept_.field && serves(kept_, key, statics_.obstacles().all());
}

void WorldIntake::make_map(const VoxelMap& map) {
  auto products = std::make_shared<const MapProducts>(map, config_);
  const std::lock_guard lock(mutex_);
  ready_.map = std::move(products);
}

}  // namespace tern
