#include "simulator/app/read_sensors.h"

#include <numbers>
#include <string>

namespace tern {
namespace {

/// Smallest rate of a periodic event, Hz: longer periods could overflow times.
constexpr double kMinRate = 1e-3;
constexpr double kMaxLatency = 2.0;  ///< s
constexpr double kDegree = std::numbers::pi / 180.0;
/// A sensor is at most this far from the vehicle's position, m.
constexpr double kMaxArm = 100.0;
constexpr int kMostPixels = 2'000;  ///< per row and column

double read_rate(ConfigSection& section, double fallback) {
  return section.number("rate_hz", fallback, Range::at_least(kMinRate, 100.0), "frames per second");
}

double read_latency(ConfigSection& section, double fallback) {
  return section.number("latency_s", fallback, Range::at_least(0.0, kMaxLatency), "delay of a frame after its time, s");
}

/// The keys of a sensor that sees whole boxes, also behind others.
void read_near(ConfigSection& section, SensorConfig& sensor) {
  const SensorConfig noisy = perception_only(sensor.seed);
  sensor.range_m =
      section.number("range_m", noisy.range_m, Range::at_least(0.0, 1e5),
                     "boxes whose nearest point is within this are detected, also behind others, m; 0: without limit");
  sensor.sigma_m = Vec3::Constant(section.number("sigma_m", noisy.sigma_m.x(), Range::at_least(0.0, 100.0),
                                                 "standard deviation of the position per axis, m"));
  sensor.latency_s = read_latency(section, noisy.latency_s);
  sensor.dropout =
      section.number("dropout", noisy.dropout, Range::at_least(0.0, 1.0), "probability that a detection is missing");
  sensor.track_ids = section.flag("ids", noisy.track_ids, "detections have the obstacle's id");
}

SensorConfig read_sensor(ConfigSection section, std::uint64_t seed) {
  SensorConfig sensor;
  sensor.seed = seed;
  sensor.rate_hz = read_rate(section, sensor.rate_hz);
  const std::string mode = section.choice("mode", "truth", {"none", "truth", "noisy"},
                                          "`none`: no sensor; `truth`: all obstacles, without noise, with ids; "
                                          "`noisy`: by the next keys, which only `noisy` has");
  sensor.present = mode != "none";
  if (mode == "noisy") read_near(section, sensor);
  section.finish();
  return sensor;
}

void read_mount(ConfigSection& section, DepthSensorConfig& sensor) {
  sensor.on_gimbal =
      section.choice("mount", "gimbal", {"gimbal", "body"},
                     "`gimbal`: level, and turned with the vehicle's heading; `body`: fixed to the body, "
                     "which tilts when the vehicle accelerates") == "gimbal";
  sensor.position = section.vec3("position", sensor.position, Range::within(kMaxArm),
                                 "place on the vehicle, forward, left and up from its position, m");
  sensor.yaw =
      kDegree * section.number("yaw_deg", 0.0, Range::within(180.0), "direction to the left of forward, degrees");
  sensor.pitch = kDegree * section.number("pitch_deg", 0.0, Range::within(90.0), "direction above forward, degrees");
}

void read_noise(ConfigSection& section, DepthNoise& noise) {
  noise.constant_m = section.number("sigma_m", noise.constant_m, Range::at_least(0.0, 10.0),
                                    "standard deviation of a depth z: sigma_m + sigma_per_m · z², m");
  noise.per_m =
      section.number("sigma_per_m", noise.per_m, Range::at_least(0.0, 1.0), "its part that grows with z², 1/m");
  noise.block = static_cast<int>(section.integer(
      "noise_block", noise.block, 1, 100,
      "blocks of so many pixels each way have the same noise, as stereo cameras have (5); 1: each pixel has its own"));
}

int read_pixels(ConfigSection& section, const char* key, int fallback) {
  const char* meaning = key[0] == 'c' ? "pixels per row" : "pixels per column";
  return static_cast<int>(section.integer(key, fallback, 2, kMostPixels, meaning));
}

DepthSensorConfig read_depth_sensor(ConfigSection& section, bool is_camera) {
  DepthSensorConfig sensor = is_camera ? default_camera() : default_lidar();
  sensor.rate_hz = read_rate(section, sensor.rate_hz);
  sensor.latency_s = read_latency(section, sensor.latency_s);
  read_mount(section, sensor);
  DepthSensor& optics = sensor.optics;
  optics.range_m = section.number("range_m", optics.range_m, Range::positive(1000.0),
                                  "farther depths are not measured, m; a camera's depth is along its axis");
  optics.least_range_m = section.number("least_range_m", optics.least_range_m, Range::at_least(0.0, 100.0),
                                        "nearer depths are not measured, m");
  read_noise(section, optics.noise);
  const int columns = read_pixels(section, "columns", optics.shape.columns);
  const int rows = read_pixels(section, "rows", optics.shape.rows);
  if (is_camera) {
    const double across =
        section.number("horizontal_fov_deg", 85.2, Range{1.0, 170.0}, "horizontal field of view, degrees");
    const double down = section.number("vertical_fov_deg", 58.0, Range{1.0, 170.0}, "vertical field of view, degrees");
    optics.shape = camera_shape(kDegree * across, kDegree * down, columns, rows);
  } else {
    const double around =
        section.number("horizontal_fov_deg", 360.0, Range{1.0, 360.0}, "horizontal field of view, degrees");
    const double lowest =
        section.number("elevation_min_deg", -7.5, Range{-90.0, -0.5},
                       "lower edge of the lowest row, degrees above the horizon; its rays are half a row higher");
    const double highest =
        section.number("elevation_max_deg", 52.5, Range{0.5, 90.0},
                       "upper edge of the highest row, degrees above the horizon; its rays are half a row lower");
    optics.shape = lidar_shape(kDegree * around, kDegree * lowest, kDegree * highest, columns, rows);
  }
  section.finish();
  if (optics.range_m <= optics.least_range_m) throw section.error("range_m", "must be above least_range_m");
  return sensor;
}

std::variant<SensorConfig, DepthSensorConfig> read_listed(ConfigSection section, std::uint64_t seed) {
  const std::string type =
      section.choice("type", "camera", {"camera", "lidar", "near", "truth"},
                     "`camera`, `lidar`: depth pictures, in which near things hide far ones; `near`: as `mode: noisy` "
                     "of `sensor`; `truth`: as its `mode: truth`");
  if (type == "camera" || type == "lidar") return read_depth_sensor(section, type == "camera");
  SensorConfig sensor;
  sensor.seed = seed;
  sensor.rate_hz = read_rate(section, sensor.rate_hz);
  if (type == "near") read_near(section, sensor);
  section.finish();
  return sensor;
}

}  // namespace

void read_sensors(ConfigSection& section, SimulatorConfig& config, std::uint64_t seed) {
  config.seed = seed;
  config.sensor = read_sensor(section.section("sensor"), seed);
  for (const ConfigSection& entry : section.list("sensors")) config.sensors.push_back(read_listed(entry, seed));
  if (!config.sensors.empty()) config.sensor.present = false;
  const std::string ground =
      section.choice("ground", "flat", {"flat", "none"},
                     "`flat`: cameras and lidars see a ground at `ground_z`; `none`: they see none");
  const double ground_z =
      section.number("ground_z", 0.0, Range::within(WorldObstacle::kMaxCoordinate), "height of the ground, W, m");
  if (ground == "flat") config.ground_z = ground_z;
}

}  // namespace tern
