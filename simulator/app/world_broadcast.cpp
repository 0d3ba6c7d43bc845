#include "simulator/app/world_broadcast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/wire/message_limits.h"
#include "core/world/track_order.h"
#include "messages/batching.h"
#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/data_folder.h"
#include "runtime/log.h"
#include "runtime/tick.h"
#include "simulator/worlds/declared_motions.h"

namespace tern {
namespace {

constexpr Duration kDeclaredPeriod{200'000};
constexpr Duration kTruthPeriod{33'333};

/// All obstacles that are present at world time 0, as static ones, with their ids.
World at_rest_at_zero(const World& world) {
  World resting;
  for (const WorldObstacle& obstacle : world.obstacles) {
    if (!obstacle.present(0.0)) continue;
    ObstacleSpec spec = obstacle.spec();
    spec.centre = obstacle.at(0.0).p;
    spec.motion = StaticMotion{};
    // Accepted as a moving obstacle, so accepted with the same shape and bounds as a static one.
    resting.obstacles.push_back(WorldObstacle::make(obstacle.id(), std::move(spec)).value());
  }
  return resting;
}

/// The obstacles that never move, with their ids.
World never_moving(const World& world) {
  World resting = world;
  std::erase_if(resting.obstacles, [](const WorldObstacle& obstacle) { return obstacle.moves(); });
  return resting;
}

/// The reason why the world's motions cannot be declared, or "".
std::string undeclarable(const World& world) {
  const PresentCount present = max_present(world, kDeclaredPast);
  if (pieces_for_each(present.moving, present.resting) == 0) {
    return fmt::format(
        "{} obstacles at once, more than the {} that DECLARED_MOTIONS holds (simulator.declare: false leaves them to "
        "the sensor)",
        present.moving + present.resting, kMaxBatches * kMaxTracksPerBatch);
  }
  for (const WorldObstacle& o : world.obstacles) {
    const double speed = o.bounds().speed.maxCoeff();
    if (speed > kMaxSpeed) {
      return fmt::format("obstacle {}{}: speed {} m/s, more than the {} m/s that DECLARED_MOTIONS holds", o.id(),
                         o.spec().name.empty() ? "" : " '" + o.spec().name + "'", speed, kMaxSpeed);
    }
  }
  return {};
}

CoarseMotions coarse_enough(const World& world) {
  const PresentCount present = max_present(world, kDeclaredPast);
  const std::size_t pieces = pieces_for_each(present.moving, present.resting);
  return coarse_motions(world, kDeclaredPast + kDeclaredAhead, std::max<std::size_t>(pieces, 1));
}

/// World times at which obstacles appear, ascending.
std::vector<Duration> appearances_of(const World& world) {
  std::vector<Duration> times;
  for (const WorldObstacle& o : world.obstacles) {
    if (std::isfinite(o.first_s())) times.push_back(Duration::from_seconds(o.first_s()));
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

void move_to(ObservationSet& set, const Belief& belief) {
  set.sensor_position = belief.of(set.sensor_position);
  for (Detection& detection : set.detections) detection.position = belief.of(detection.position);
}

World world_of(const Scenario& scenario) {
  const std::string data = data_folder(scenario.file, std::getenv("TERN_DATA"));
  return value_or_throw(make_world(scenario, data), scenario.file + ": world: ");
}

World flyable_world_of(const Scenario& scenario, const SimulatorConfig& config) {
  if (!config.sensors.empty() && config.ground_z && *config.ground_z > scenario.uav.start.z()) {
    throw ConfigError(
        fmt::format("{}: simulator.ground_z: {} m is above uav.start, at {} m: the sensors would see nothing. Set "
                    "simulator.ground_z, or simulator.ground: none",
                    scenario.file, *config.ground_z, scenario.uav.start.z()));
  }
  World world = world_of(scenario);
  const std::string why = config.declare ? undeclarable(world) : "";
  if (!why.empty()) throw ConfigError(scenario.file + ": world: " + why);
  const double ground_z = config.vio ? config.vio->landmarks.ground_z_m : 0.0;
  if (config.vio && scenario.uav.flight_box.min().z() < ground_z) {
    world.remarks.push_back(
        fmt::format("uav.flight_box reaches below the ground at {} m (simulator.vio.landmarks.ground_z_m): from there "
                    "the camera sees nothing, and the estimate drifts",
                    ground_z));
  }
  return world;
}

WorldBroadcast::WorldBroadcast(Bus& bus, const World& world, const SimulatorConfig& config, UTime now)
    : bus_(bus),
      world_(world),
      before_(config.declare ? at_rest_at_zero(world) : never_moving(world)),
      config_(config),
      frames_zero_(now),
      next_declared_(now),
      next_truth_(now),
      last_declared_(now) {
  if (!config.declare) return;
  coarse_ = coarse_enough(world);
  appearances_ = appearances_of(world);
}

void WorldBroadcast::start(UTime world_zero, UTime now) {
  world_zero_ = frames_zero_ = world_zero;
  frame_ = static_cast<std::int64_t>(std::ceil((now - world_zero).seconds() * config_.sensor.rate_hz));
  // The declared rest ends at world zero, so the motions are declared at once.
  next_declared_ = now;
}

UTime WorldBroadcast::next_wakeup() const {
  UTime next = next_truth_;
  if (config_.sensor.present) next = std::min(next, frame_arrives(config_.sensor, frames_zero_, frame_));
  return config_.declare ? std::min(next, declared_due()) : next;
}

UTime WorldBroadcast::declared_due() const {
  if (appearances_.empty()) return next_declared_;
  return std::min(next_declared_, std::max(world_zero_ + appearances_.front(), last_declared_ + kDeclaredApart));
}

void WorldBroadcast::step(UTime now, const MotionHistory& uav, const Navigation* navigation) {
  if (config_.sensor.present) publish_observations(now, uav, navigation);
  if (config_.declare && now >= declared_due()) {
    publish_declared(now, uav.sample(std::min(now, uav.end())).p);
    if (now >= next_declared_) next_declared_ = next_tick(next_declared_, kDeclaredPeriod, now);
  }
  if (now >= next_truth_) {
    publish_truth(now);
    next_truth_ = next_tick(next_truth_, kTruthPeriod, now);
  }
}

bool WorldBroadcast::is_before_world(UTime t) const {
  return world_zero_ == kFarFuture || (config_.declare && t < world_zero_);
}

void WorldBroadcast::publish_observations(UTime now, const MotionHistory& uav, const Navigation* navigation) {
  for (; frame_arrives(config_.sensor, frames_zero_, frame_) <= now; ++frame_) {
    const UTime taken = frame_taken(config_.sensor, frames_zero_, frame_);
    const Vec3 eye = uav.sample(std::min(taken, uav.end())).p;
    const World& seen = world_at(taken);
    ObservationSet set = observe(seen, config_.sensor, frames_zero_, frame_, eye);
    if (navigation != nullptr) move_to(set, navigation->belief_at(taken));
    bus_.publish(channels::kObstacleObservations, std::move(set));
  }
}

void WorldBroadcast::publish_declared(UTime now, const Vec3& uav) {
  TrackSet set = declare_motions(world_, world_zero_, now - kDeclaredPast, now + kDeclaredAhead, coarse_);
  // An obstacle is not declared before its motion begins: extrapolated into the past its box would grow.
  std::erase_if(set.tracks, [now](const Track& track) { return track.motion.start > now; });
  set.batch.set = ++declared_set_;
  set.made_at = now;
  sort_by_reach(set.tracks, uav, now, kDeclaredAhead);
  std::vector<TrackSet> batches = split_batches(set);
  report_left_out(batches.front().left_out, set.tracks.size());
  bus_.publish_paced(channels::kDeclaredMotions, std::move(batches));
  last_declared_ = now;
  std::erase_if(appearances_, [&](Duration t) { return world_zero_ + t <= now; });
}

void WorldBroadcast::report_left_out(std::int32_t left_out, std::size_t of) {
  const bool is_new = left_out > 0 && trouble_.empty();
  trouble_.clear();
  if (left_out > 0) trouble_ = fmt::format("{} of {} motions do not fit into DECLARED_MOTIONS", left_out, of);
  if (is_new) log::warn("{}: the farthest motions are left out", trouble_);
}

void WorldBroadcast::publish_truth(UTime now) {
  ObstacleTruth truth;
  truth.batch.set = ++truth_set_;
  truth.at = now;
  truth.obstacles =
      is_before_world(now) ? true_obstacles(before_, 0.0) : true_obstacles(world_, (now - world_zero_).seconds());
  bus_.publish_paced(channels::kObstacleTruth, split_batches(truth));
}

}  // namespace tern
