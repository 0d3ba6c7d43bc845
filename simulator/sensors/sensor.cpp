#include "simulator/sensors/sensor.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

#include "core/base/random.h"

namespace tern {
namespace {

void require(bool holds, const char* what, double value) {
  if (!holds) throw std::invalid_argument(std::string("sensor: ") + what + " " + std::to_string(value));
}

void require_valid(const SensorConfig& c) {
  require(c.rate_hz > 0.0 && c.rate_hz <= 1e4, "rate_hz not in (0, 1e4]:", c.rate_hz);
  require(c.range_m >= 0.0, "range_m negative:", c.range_m);
  require(c.sigma_m.minCoeff() >= 0.0, "sigma_m negative:", c.sigma_m.minCoeff());
  require(c.latency_s >= 0.0, "latency_s negative:", c.latency_s);
  require(c.dropout >= 0.0 && c.dropout <= 1.0, "dropout not in [0, 1]:", c.dropout);
  require(c.max_detections >= 0, "max_detections negative:", c.max_detections);
}

/// The seed of a frame (splitmix64): neighbouring frames are independent.
std::uint64_t frame_seed(std::uint64_t seed, std::int64_t frame) {
  std::uint64_t x = seed + 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(frame) + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

void keep_nearest(std::vector<TrueObstacle>& seen, const Vec3& eye, std::size_t count) {
  if (seen.size() <= count) return;
  const auto key = [&](const TrueObstacle& o) {
    return std::make_pair(distance_to_box(eye, o.position, o.half_extents), o.id);
  };
  std::nth_element(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), seen.end(),
                   [&](const TrueObstacle& a, const TrueObstacle& b) { return key(a) < key(b); });
  seen.resize(count);
  std::ranges::sort(seen, [](const TrueObstacle& a, const TrueObstacle& b) { return a.id < b.id; });
}

}  // namespace

SensorConfig perception_only(std::uint64_t seed) {
  SensorConfig config;
  config.range_m = 8.0;
  config.sigma_m = Vec3::Constant(0.05);
  config.latency_s = 0.05;
  config.dropout = 0.05;
  config.track_ids = false;
  config.seed = seed;
  return config;
}

UTime frame_taken(const SensorConfig& config, UTime world_zero, std::int64_t frame) {
  return world_zero + Duration::from_seconds(static_cast<double>(frame) / config.rate_hz);
}

UTime frame_arrives(const SensorConfig& config, UTime world_zero, std::int64_t frame) {
  return frame_taken(config, world_zero, frame) + Duration::from_seconds(config.latency_s);
}

ObservationSet observe(const World& world, const SensorConfig& config, UTime world_zero, std::int64_t frame,
                       const Vec3& sensor_position) {
  require_valid(config);
  ObservationSet set;
  set.at = frame_taken(config, world_zero, frame);
  set.sensor_id = config.sensor_id;
  set.range_m = config.range_m;
  set.sensor_position = sensor_position;

  std::vector<TrueObstacle> seen = true_obstacles(world, (set.at - world_zero).seconds());
  if (config.range_m > 0.0) {
    std::erase_if(seen, [&](const TrueObstacle& o) {
      return distance_to_box(sensor_position, o.position, o.half_extents) > config.range_m;
    });
  }
  keep_nearest(seen, sensor_position, static_cast<std::size_t>(config.max_detections));

  Rng rng(frame_seed(config.seed, frame));
  for (const TrueObstacle& o : seen) {
    const bool dropped = rng.uniform() < config.dropout;
    const double nx = rng.normal();
    const double ny = rng.normal();
    const double nz = rng.normal();
    if (dropped) continue;
    Detection d;
    d.position = o.position + config.sigma_m.cwiseProduct(Vec3(nx, ny, nz));
    d.half_extents = o.half_extents;
    d.variance = config.sigma_m.cwiseAbs2();
    d.track_id = config.track_ids ? o.id : kNoTrackId;
    set.detections.push_back(d);
  }
  if (!config.track_ids) {
    const auto key = [](const Detection& d) { return std::make_tuple(d.position.x(), d.position.y(), d.position.z()); };
    std::ranges::sort(set.detections, [&](const Detection& a, const Detection& b) { return key(a) < key(b); });
  }
  return set;
}

}  // namespace tern
