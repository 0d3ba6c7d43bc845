// The estimator's configuration: the noise of the IMU, the start, and the bounds of the filter.
#pragma once

#include "core/base/knobs.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/frames.h"
#include "core/world/vehicle.h"

namespace tern {

/// Noise of an IMU as spectral densities. The default was measured in flight: a_n is the growth of the velocity error
/// of a flying ADIS16448. Vibration raises it to ten times the data sheet's. A filter that assumes too much noise
/// loses little; one that assumes too little is wrong about its own error.
struct ImuNoise {
  double accel = 2.8e-2;       ///< a_n, m/s²/√Hz
  double accel_walk = 3.0e-3;  ///< a_w, of the accelerometer's bias, m/s³/√Hz
  double gyro = 3.4e-4;        ///< g_n, rad/s/√Hz
  double gyro_walk = 1.94e-5;  ///< g_w, of the gyroscope's bias, rad/s²/√Hz

  template <typename V>
  void visit(V& v) {
    v("accel", accel, Range::positive(10.0), "noise density of the accelerometer in flight, m/s²/√Hz");
    v("accel_walk", accel_walk, Range::positive(1.0), "random walk of the accelerometer's bias, m/s³/√Hz");
    v("gyro", gyro, Range::positive(1.0), "noise density of the gyroscope in flight, rad/s/√Hz");
    v("gyro_walk", gyro_walk, Range::positive(1.0), "random walk of the gyroscope's bias, rad/s²/√Hz");
  }
};

struct EstimatorConfig {
  ImuNoise noise;
  double gravity = kGravity;           ///< m/s²
  int clones = 11;                     ///< poses of past frames in the state
  int features_per_update = 30;        ///< features used with one frame; further ended tracks are dropped
  double rest_s = 1.0;                 ///< how long the vehicle must rest at the start, s
  double start_deviation = 1e-3;       ///< of the position there, per axis, m
  double start_yaw_deviation = 1e-3;   ///< rad
  double accel_bias_deviation = 0.03;  ///< of the unknown bias at the start, per axis, m/s²
  double max_step = 0.01;              ///< m: a larger correction of the newest position moves T_WO instead of O
  double max_turn = 0.01;              ///< rad: the same for yaw

  template <typename V>
  void visit(V& v) {
    v("noise", noise);
    v("gravity", gravity, Range{9.7, 9.9}, "magnitude of gravity, m/s²");
    v("clones", clones, Range{3, 30}, "number of past poses in the filter's state");
    v("features_per_update", features_per_update, Range{1, 500},
      "largest number of features in the update of one frame; ended tracks beyond it are dropped, others wait for the "
      "next frame");
    v("rest_s", rest_s, Range{0.5, 60.0}, "how long the vehicle must rest before the estimate begins, s");
    v("start_deviation_m", start_deviation, Range::positive(1e3), "standard deviation of the start per axis, m");
    v("start_yaw_deviation", start_yaw_deviation, Range::positive(3.0), "standard deviation of the yaw there, rad");
    v("accel_bias_deviation", accel_bias_deviation, Range::positive(5.0),
      "standard deviation of the accelerometer's unknown bias at the start, m/s²");
    v("max_step_m", max_step, Range::positive(10.0),
      "a larger correction of the newest position changes T_WO and leaves the odometry frame unchanged, m");
    v("max_turn", max_turn, Range::positive(1.0), "the same for a correction of yaw, rad");
  }
};

/// Where the vehicle rests at the start.
struct RestPlace {
  PointInW position;  ///< of the body, m
  double yaw = 0.0;   ///< rad
};

/// A state of motion that is known at the start, instead of a rest from which it is measured.
struct StartState {
  UTime at;
  PoseInW pose;
  VectorInW velocity;              ///< m/s
  Vec3 gyro_bias = Vec3::Zero();   ///< rad/s
  Vec3 accel_bias = Vec3::Zero();  ///< m/s²
  /// Standard deviations per axis: rad, m, m/s, rad/s, m/s².
  double attitude_deviation = 0.01, position_deviation = 1e-3, velocity_deviation = 0.01;
  double gyro_bias_deviation = 2e-4, accel_bias_deviation = 0.03;
};

}  // namespace tern
