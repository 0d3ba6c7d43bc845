#include "simulator/app/sensor_broadcast.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "messages/codec.h"
#include "runtime/node.h"
#include "simulator/app/world_broadcast.h"
#include "simulator/inertial/navigation.h"

namespace tern {
namespace {

/// Attitudes are kept for the largest latency, 2 s, and a little more.
constexpr Duration kRemembered{2'500'000};

}  // namespace

SensorBroadcast::SensorBroadcast(Bus& bus, const SimulatorConfig& config, UTime now)
    : bus_(bus), ground_z_(config.ground_z), frames_zero_(now) {
  std::int32_t id = 0;
  for (const auto& sensor : config.sensors) {
    if (const auto* depth = std::get_if<DepthSensorConfig>(&sensor)) {
      sensors_.push_back({SimulatedDepthSensor(*depth, id, config.seed), depth->rate_hz, depth->latency_s});
    } else {
      SensorConfig boxes = std::get<SensorConfig>(sensor);
      boxes.sensor_id = id;
      sensors_.push_back({boxes, boxes.rate_hz, boxes.latency_s});
    }
    ++id;
  }
}

void SensorBroadcast::start(UTime world_zero, UTime now) {
  frames_zero_ = world_zero;
  for (Mounted& sensor : sensors_) {
    sensor.frame = static_cast<std::int64_t>(std::ceil((now - world_zero).seconds() * sensor.rate_hz));
  }
}

UTime SensorBroadcast::taken(const Mounted& sensor) const {
  return frames_zero_ + Duration::from_seconds(static_cast<double>(sensor.frame) / sensor.rate_hz);
}

UTime SensorBroadcast::arrives(const Mounted& sensor) const {
  return taken(sensor) + Duration::from_seconds(sensor.latency_s);
}

UTime SensorBroadcast::next_wakeup() const {
  UTime next = kNever;
  for (const Mounted& sensor : sensors_) next = std::min(next, arrives(sensor));
  return next;
}

void SensorBroadcast::remember(const Vehicle& vehicle) {
  if (sensors_.empty()) return;
  const UTime end = vehicle.truth().end();
  if (attitudes_.empty() || attitudes_.back().first < end) attitudes_.emplace_back(end, vehicle.attitude());
  while (attitudes_.size() > 1 && attitudes_[1].first < end - kRemembered) attitudes_.pop_front();
}

Eigen::Quaterniond SensorBroadcast::attitude_at(UTime t) const {
  const auto after =
      std::partition_point(attitudes_.begin(), attitudes_.end(), [&](const auto& a) { return a.first < t; });
  if (after == attitudes_.end()) return attitudes_.back().second;
  if (after == attitudes_.begin()) return after->second;
  const auto before = std::prev(after);
  const double share = (t - before->first).seconds() / (after->first - before->first).seconds();
  return before->second.slerp(share, after->second);
}

void SensorBroadcast::publish(Mounted& sensor, Vehicle& vehicle, const World& world) {
  const UTime at = taken(sensor);
  const Vec3 p_WB = vehicle.truth().sample(std::min(at, vehicle.truth().end())).p;
  const Belief belief = vehicle.navigation() ? vehicle.navigation()->belief_at(at) : Belief{};
  if (const auto* boxes = std::get_if<SensorConfig>(&sensor.model)) {
    ObservationSet set = observe(world, *boxes, frames_zero_, sensor.frame, p_WB);
    move_to(set, belief);
    bus_.publish(channels::kObstacleObservations, std::move(set));
    return;
  }
  boxes_.clear();
  for (const TrueObstacle& o : true_obstacles(world, (at - frames_zero_).seconds())) {
    boxes_.push_back(box_around(o.position, o.half_extents));
  }
  auto& depth = std::get<SimulatedDepthSensor>(sensor.model);
  const SensorPose pose = mounted(depth.config(), p_WB, attitude_at(at));
  const SensorPose believed{belief.of(pose.position), Eigen::Quaterniond(belief.R) * pose.q_WC};
  bus_.publish(channels::kObstacleSightings, depth.look({boxes_, map_, ground_z_}, pose, believed, at, sensor.frame));
}

}  // namespace tern
