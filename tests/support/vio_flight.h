// Simulated flights for tests of the estimator: a path, an IMU by exact integrals, landmarks on surfaces, and tracks
// with losses and wrong matches.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/world/inertial.h"
#include "estimator/config.h"
#include "estimator/estimator.h"
#include "estimator/filter/motion.h"

namespace tern::support {

struct VioCamera {
  double focal = 460.0, width = 848.0, height = 480.0;  ///< px
  double baseline = 0.11;                               ///< m
  Vec3 p_BC = Vec3(0.1, 0.055, 0.02);                   ///< m
  double rate_hz = 20.0;
  double deviation_px = 1.0;
  int most_tracks = 150;
  double loss = 0.02, wrong = 0.002;  ///< per frame and track
  double range = 25.0;                ///< m
};

/// Landmarks: Poisson processes on the ground and on two walls along x.
struct VioWorld {
  double ground = 1.0, wall = 8.0;  ///< per m²
  double wall_y = 6.0, wall_height = 4.0;
  double length = 90.0;                      ///< m, from x = −10
  std::pair<double, double> bare{0.0, 0.0};  ///< nothing grows between these x, m
};
std::vector<Vec3> landmarks_of(const VioWorld& world, std::uint64_t seed);

/// The path of a flight. The truth follows a guide's velocity and yaw, by the attitude that its acceleration needs.
struct VioPath {
  std::function<Vec3(double)> velocity;  ///< W, m/s, at a time of the flight, s
  std::function<double(double)> yaw;     ///< rad
  Vec3 start = Vec3(0.0, 0.0, 1.5);      ///< m
  double rest = 1.6;                     ///< s at rest before time 0
  double duration = 16.0;                ///< s of flight
};
/// Weaves along x at about 5 m/s, with yaw.
VioPath weaving(double speed = 5.0);

struct VioSettings {
  VioCamera camera;
  ImuNoise noise;  ///< of the simulated IMU
  double imu_hz = 200.0;
  double gyro_bias = 5e-3, accel_bias = 0.03;     ///< standard deviations of the biases at the start
  std::vector<std::pair<double, double>> dark{};  ///< spans of flight time in which the camera sees nothing, s
};

/// One sample or frame, in the order of time; a frame follows the sample of its time.
struct VioEvent {
  bool is_frame = false;
  ImuSample sample;
  FeatureFrame frame;
  NavState truth;  ///< at the event's time
  double t = 0.0;  ///< of the flight, s
};

/// Simulates a flight.
std::vector<VioEvent> simulate(const VioPath& path, const std::vector<Vec3>& landmarks, const VioSettings& settings,
                               std::uint64_t seed);

/// Sees landmarks by a camera over time: keeps tracks, loses and mismatches some.
class FeatureTracker {
 public:
  FeatureTracker(const VioCamera& camera, std::uint64_t seed) : camera_(camera), random_(seed) {}
  FeatureFrame see(const NavState& truth, const std::vector<Vec3>& landmarks, UTime at, bool dark = false);

 private:
  VioCamera camera_;
  Rng random_;
  std::vector<std::pair<std::size_t, std::int64_t>> tracks_;  // landmark, id
  std::int64_t next_id_ = 1;
};

/// The pose error's NEES over its 6 degrees of freedom and the norm of the position error, of an estimate.
struct VioError {
  double nees = 0.0;
  double position = 0.0;       ///< m
  double position_nees = 0.0;  ///< 3 degrees of freedom
  double sigma = 0.0;          ///< √tr of the position's covariance, m
};
VioError error_of_estimate(const Estimate& estimate, const NavState& truth);

}  // namespace tern::support
