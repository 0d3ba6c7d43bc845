// The vehicle's side of an estimate: measures the IMU, and carries the newest ODOMETRY on to the present.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/world/frames.h"
#include "core/world/inertial.h"
#include "core/world/vehicle_status.h"
#include "simulator/inertial/camera_frame.h"
#include "simulator/inertial/imu.h"

namespace tern {

/// One exposure of the cameras.
struct StereoExposure {
  UTime at;
  InertialState truth;
  Vec3 rate = Vec3::Zero();  ///< body rates, rad/s
};

/// Maps the true world to the world as the vehicle believes it to be: it takes its true pose to its believed one.
struct Belief {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();  ///< believed = R·true + p, m
  [[nodiscard]] Vec3 of(const Vec3& p_true) const { return R * p_true + p; }
};

/// Measures IMU samples of kImuStep from the true motion, and derives from them and from ODOMETRY where the vehicle
/// believes itself to be.
///
/// | quantity      | definition                                                                                    |
/// |---------------|-----------------------------------------------------------------------------------------------|
/// | pose in O     | the newest ODOMETRY, moved by all later samples; the biases that it reports are subtracted     |
/// | believed pose | T·(pose in O). T follows T_WO; it moves the vehicle at kCorrectionSpeed at most               |
///
/// The believed pose never jumps, even if T_WO does: the controller and the committed trajectory see a slow drift.
/// outstanding() is the part of a correction that is still to come.
///
/// The estimate is usable if ODOMETRY reports Tracking or Blind, and is at most kMaxAge old. The largest standard
/// deviation of the position over all directions must not exceed max_sigma_m. Deterministic from the seed and the
/// inputs.
class Navigation {
 public:
  static constexpr Duration kImuStep{5'000};
  static constexpr Duration kMaxAge{300'000};        ///< as other inputs of the vehicle (executor/vehicle_inputs.h)
  static constexpr double kCorrectionSpeed = 0.1;    ///< m/s
  static constexpr Duration kRemembered{4'000'000};  ///< beliefs, for sensors with latency

  Navigation(const ImuSpec& imu, const StereoSpec& camera, double max_sigma_m, std::uint64_t seed,
             const InertialState& start, UTime now);

  /// Takes the true state one kImuStep after the last one, with its body rates.
  void advance(const InertialState& truth, const Vec3& rate);
  /// Takes an ODOMETRY. One that is older than the newest, or later than the newest sample, changes nothing.
  void receive(const Odometry& odometry);

  /// Returns the samples since the last call.
  std::vector<ImuSample> take_samples();
  /// Returns the exposures since the last call.
  std::vector<StereoExposure> take_exposures();

  [[nodiscard]] UTime now() const { return now_; }
  /// The believed state at now(); nullopt before the first valid ODOMETRY.
  [[nodiscard]] std::optional<InertialState> believed() const;
  /// The belief at t, or at the nearest remembered time; the identity before the first valid ODOMETRY.
  [[nodiscard]] Belief belief_at(UTime t) const;
  /// Distance between the believed position and the estimator's in W, m.
  [[nodiscard]] double outstanding() const;
  /// Why the estimate is not usable, in words; empty if it is.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] EstimatorHealth health() const;
  /// Standard deviation of the position's drift in one second, per axis of W, m; 0 before the first valid ODOMETRY.
  [[nodiscard]] Vec3 drift_sigma() const;
  /// The largest standard deviation of the position in W over all directions, m.
  [[nodiscard]] double position_sigma() const;
  [[nodiscard]] const std::optional<Odometry>& odometry() const { return odometry_; }

 private:
  struct Measured {
    UTime at;
    InertialSample sample;
  };
  void integrate(const Measured& measured, double h_s);
  void follow_offset(double h_s);
  [[nodiscard]] bool is_valid() const;

  SimulatedImu imu_;
  Duration frame_period_;
  double max_sigma_m_;
  UTime begun_, now_;
  InertialState truth_;
  std::vector<ImuSample> samples_;
  std::vector<StereoExposure> exposures_;
  std::deque<Measured> since_odometry_;
  std::optional<Odometry> odometry_;
  InertialState odometry_state_;          ///< at now_
  std::optional<OdometryOffset> offset_;  ///< T
  std::deque<std::pair<UTime, Belief>> beliefs_;
};

}  // namespace tern
