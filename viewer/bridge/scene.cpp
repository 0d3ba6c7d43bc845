#include "viewer/bridge/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/scenario/obstacle_names.h"
#include "core/world/flyable.h"
#include "messages/channels.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

/// Greatest age of VEHICLE_TRUTH, relative to the state, for which it stands for the vehicle.
constexpr Duration kTruthAge{100'000};

double ball_radius(const Body& body) { return body.vertices.colwise().norm().maxCoeff() + body.radius; }

bool same_shape(const Body& a, const Body& b) {
  return a.radius == b.radius && a.vertices.cols() == b.vertices.cols() && a.vertices == b.vertices;
}

}  // namespace

void Scene::receive(const UavState& message) {
  const std::int64_t epoch_us = message.header.name.sender_epoch_us;
  const bool is_its_own =
      goal_ && (goal_->header.name.sender_epoch_us == epoch_us || goal_->header.utime.us > epoch_us);
  if (state_ && epoch_us != vehicle_us() && goal_ && !is_its_own) {
    goal_.reset();
    mark(Topic::Goal);
  }
  state_ = message;
  remember_state();
  for (const Topic topic : {Topic::State, Topic::Chart, Topic::Path, Topic::Events}) mark(topic);
  if (!sightings_.empty()) mark(Topic::Sight);  ///< what was seen lately depends on the time
}

void Scene::remember_state() {
  if (memory_ == nullptr) return;
  memory_->events.receive(*state_);
  const auto obstacles = clearance(), map = map_clearance();
  memory_->events.receive_clearance(state_->at, obstacles,
                                    map);  ///< before thinning, so the least clearance is not lost
  if (!memory_->history.keeps_row(channels::kUavState.name, state_->at)) return;
  memory_->history.add(*state_);
  remember(channels::kUavState.name, state_->at, vehicle_numbers(*this));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const NumberFields fields{{"clearance.obstacles_m", obstacles.value_or(kNone)},
                            {"clearance.map_m", map.value_or(kNone)}};
  remember("clearance", state_->at, fields);
}

void Scene::remember(const std::string& table, UTime at, const NumberFields& fields) {
  if (memory_->history.add_row(table, at, fields)) mark(Topic::Fields);
}

void Scene::receive(const ObstacleTruth& complete_set) {
  truth_ = complete_set;
  mark(Topic::Truth);
}

void Scene::receive_truth(const UavState& message) { true_state_ = message; }

void Scene::receive(const ObservationSet& message) {
  if (!detections_.contains(message.sensor_id) && detections_.size() >= kMaxSensors) return;
  detections_[message.sensor_id] = message;
  mark(Topic::Tracked);
}

void Scene::receive(const SightingSet& message) {
  if (!sightings_.contains(message.sensor_id) && sightings_.size() >= kMaxSensors) return;
  sightings_[message.sensor_id] = message;
  seen_.add(message);
  mark(Topic::Views);
  mark(Topic::Sight);
}

void Scene::receive(TrackSet complete_set) {
  if (memory_ != nullptr) memory_->ages.receive(complete_set);
  mark(Topic::Tracked);
  tracks_ = std::move(complete_set);
  mark(Topic::Tracks);
}

void Scene::receive(const HorizonRequest& message) {
  if (!body_ || !same_shape(request_->body, message.body)) body_.emplace(message.body);
  request_ = message;
  if (memory_ != nullptr) memory_->world_time.receive(message);
  request_times_[message.id] = {message.header.utime, message.deadline};
  while (request_times_.size() > kRememberedRequests) request_times_.erase(request_times_.begin());
  mark(Topic::Request);
}

void Scene::receive(const Plan& message) {
  plan_ = message;
  if (memory_ != nullptr) memory_->events.receive(message);
  mark(Topic::Plan);
  mark(Topic::Hulls);
}

void Scene::receive(const PlanHeading& message) {
  heading_ = message;
  mark(Topic::Views);
}

void Scene::receive(const Odometry& message) {
  odometry_ = message;
  mark(Topic::Estimate);
  if (memory_ == nullptr || !memory_->history.keeps_row("estimate", message.at)) return;
  remember("estimate", message.at, estimate_numbers(*this));
}

void Scene::receive(const FeatureFrame& message) {
  features_ = message;
  mark(Topic::Estimate);
}

void Scene::receive(const PlanTiming& message) {
  timing_ = message;
  mark(Topic::Timing);
  if (memory_ == nullptr || !plan_ || plan_->request_id != message.request_id) return;
  const UTime at = message.header.utime;
  memory_->events.receive(message, taken_ms(), allowed_ms());
  memory_->history.add_answer(at, plan_->outcome);
  if (!memory_->history.keeps_row(channels::kPlan.name, at)) return;
  remember(channels::kPlan.name, at, plan_numbers(*this));
}

void Scene::receive(const SearchView& message) {
  search_ = message;
  mark(Topic::Search);
}

void Scene::receive(const Goal& message) {
  if (goal_ && message.id < goal_->id) return;
  goal_ = message;
  if (memory_ != nullptr) {
    memory_->events.receive(message);
    memory_->world_time.receive(message);
  }
  mark(Topic::Goal);
}

void Scene::receive(const FlightResult& message) {
  result_ = message;
  if (memory_ != nullptr) memory_->events.receive(message);
  mark(Topic::Result);
}

void Scene::receive(const Heartbeat& message, UTime now) {
  if (!processes_.contains(message.process) && processes_.size() >= kMaxProcesses) return;
  if (memory_ != nullptr) memory_->events.receive(message);
  ObservedProcess& process = processes_[message.process];
  process.heartbeat = message;
  process.received = now;
  mark(Topic::Health);
}

void Scene::receive(const ConfigurationReport& message) {
  const bool knows_all = message.process == "tern-simulator";
  if (auto names = tern::obstacle_names(message.yaml); !names.empty() && (knows_all || obstacle_names_.empty())) {
    obstacle_names_ = std::move(names);
  }
  const auto found = processes_.find(message.process);
  if (found != processes_.end()) found->second.configuration = message;
}

void Scene::receive(const VoxelMap& map) {
  DrawnMap seen{voxel_surface(map), map.grid, map.version, map.class_names, {}};
  for (const VoxelLabel label : map.labels) ++seen.voxels[idx(label)];
  map_ = std::move(seen);
  mark(Topic::Map);
}

void Scene::clear() {
  const bool map_changed = changed_.test(idx(Topic::Map));
  auto map = std::move(map_);
  *this = Scene(memory_, pace_);
  map_ = std::move(map);
  changed_.set();
  changed_.set(idx(Topic::Map), map_changed);
}

Vec3 Scene::position() const {
  const bool is_known =
      true_state_ && state_->at - true_state_->at <= kTruthAge && true_state_->at - state_->at <= kTruthAge;
  if (!is_known) return state_->motion.p;
  return true_state_->motion.p + (state_->at - true_state_->at).seconds() * true_state_->motion.v;
}

std::optional<double> Scene::clearance() const {
  if (!state_ || !truth_ || !body_ || truth_->obstacles.empty()) return std::nullopt;
  double nearest = std::numeric_limits<double>::infinity();
  const double since = (state_->at - truth_->at).seconds();
  const Vec3 p = position();
  for (const TrueObstacle& o : truth_->obstacles) {
    const Vec3 p_rel = p - (o.position + since * o.velocity);
    // A bound that is cheap for bodies of any shape: the ball around the body.
    const double outside = box_around(Vec3::Zero(), o.half_extents).exteriorDistance(p_rel);
    if (outside > 0.0 && outside - body_radius() >= nearest) continue;
    nearest = std::min(nearest, (*body_)(p_rel, o.half_extents));
  }
  return nearest;
}

std::optional<double> Scene::clearance_of(std::int64_t id) const {
  if (!state_ || !truth_ || !body_) return std::nullopt;
  const auto o = std::ranges::find(truth_->obstacles, id, &TrueObstacle::id);
  if (o == truth_->obstacles.end()) return std::nullopt;
  return (*body_)(position() - (o->position + (state_->at - truth_->at).seconds() * o->velocity), o->half_extents);
}

std::optional<double> Scene::map_clearance() const {
  if (!state_ || !map_ || !body_) return std::nullopt;
  const double nearest = distance_to_occupied(map_->surface, *body_, position());
  return std::isfinite(nearest) ? std::optional(nearest) : std::nullopt;
}

double Scene::body_radius() const { return request_ ? ball_radius(request_->body) : 0.0; }

bool Scene::has_room_at(const Vec3& p) const {
  return !request_ || centre_box(request_->flight_box, request_->body).contains(p);
}

const Scene::RequestTimes* Scene::timed_request() const {
  if (!timing_) return nullptr;
  const auto found = request_times_.find(timing_->request_id);
  return found == request_times_.end() ? nullptr : &found->second;
}

double Scene::allowed_ms() const {
  return timed_request() ? (timed_request()->deadline - timed_request()->at).seconds() * 1e3 : 0.0;
}

double Scene::taken_ms() const {
  const bool is_answer = timed_request() && plan_ && plan_->request_id == timing_->request_id;
  return is_answer ? (plan_->header.utime - timed_request()->at).seconds() * 1e3 : 0.0;
}

bool Scene::take_change(Topic topic) {
  const auto k = idx(topic);
  const bool changed = changed_.test(k);
  changed_.reset(k);
  return changed;
}

}  // namespace tern
