// The messages IMU, FEATURE_TRACKS, POSITION_FIX and ODOMETRY: the inputs and the output of a visual-inertial
// estimator. Frames: B is the body (x forward, y left, z up), W the world, O the odometry frame (frames.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// One measurement of an inertial measurement unit: means over the time since the previous sample.
struct ImuSample {
  UTime at;                              ///< end of this time, vehicle's clock
  Vec3 angular_velocity = Vec3::Zero();  ///< B, rad/s
  Vec3 specific_force = Vec3::Zero();    ///< B, m/s²; at rest +g upwards
};

/// IMU: consecutive samples of one unit, in ascending order of time.
struct ImuBatch {
  Header header;
  std::int32_t sensor_id = 0;
  double saturation_rate = 0.0;   ///< rad/s, ≥ 0; 0: unknown. A sample that reaches it is saturated
  double saturation_force = 0.0;  ///< m/s², ≥ 0; 0: unknown
  std::vector<ImuSample> samples;
};
inline constexpr int kMaxImuSamples = 400;

/// One tracked feature in one stereo frame, in normalized image coordinates (x/z, y/z) of the rectified cameras.
struct StereoFeature {
  std::int64_t id = 0;                              ///< the same in all frames of a track, ≥ 0
  Eigen::Vector2d left = Eigen::Vector2d::Zero();   ///< in the left camera C
  Eigen::Vector2d right = Eigen::Vector2d::Zero();  ///< in the right camera, with has_right
  bool has_right = true;
};

/// FEATURE_TRACKS: the features that a stereo pair tracks in one frame. Camera C (x right, y down, z forward) is the
/// left one; the right one lies `baseline_m` along C's x.
struct FeatureFrame {
  Header header;
  UTime at;  ///< middle of the exposure, vehicle's clock
  std::int32_t sensor_id = 0;
  Vec3 p_BC = Vec3::Zero();          ///< position of C in B, m
  Eigen::Vector4d q_BC{1, 0, 0, 0};  ///< w, x, y, z of the unit quaternion that turns C into B
  double baseline_m = 0.1;           ///< > 0
  double sigma = 1e-3;               ///< of a normalized coordinate, > 0: one pixel over the focal length
  std::vector<StereoFeature> features;
};
inline constexpr int kMaxFeatures = 1'000;

/// POSITION_FIX: a position, and perhaps a yaw, from outside: satellites, a tag, a tracking room.
struct PositionFix {
  Header header;
  UTime at;  ///< vehicle's clock
  std::int32_t sensor_id = 0;
  Vec3 position = Vec3::Zero();  ///< of the body, W, m
  Vec3 variance = Vec3::Ones();  ///< per axis of W, m², > 0
  bool has_yaw = false;
  double yaw = 0.0;           ///< with has_yaw: rad, (−π, π]
  double yaw_variance = 1.0;  ///< with has_yaw: rad², > 0
};

enum class EstimatorState : std::uint8_t {
  Starting,  ///< waits for inputs or for rest; the pose is not valid
  Tracking,  ///< inertial and visual inputs are used
  Blind,     ///< inertial inputs only: no feature was used lately
  Lost,      ///< the inputs contradict each other or are missing; the pose must not be used
};

/// ODOMETRY: the estimate. A large correction changes the transform T_WO and counts its epoch up; position and yaw in O
/// stay (frames.h). Covariances are about the true pose in W.
struct Odometry {
  Header header;
  UTime at;  ///< vehicle's clock
  EstimatorState state = EstimatorState::Starting;
  std::int64_t epoch = 0;                  ///< counts the corrections of T_WO, ≥ 0
  Vec3 p_OB = Vec3::Zero();                ///< m
  Eigen::Vector4d q_OB{1, 0, 0, 0};        ///< w, x, y, z of the unit quaternion that turns B into O
  Vec3 v_OB = Vec3::Zero();                ///< velocity, O, m/s
  Vec3 angular_velocity = Vec3::Zero();    ///< B, bias removed, rad/s
  Vec3 p_WO = Vec3::Zero();                ///< of T_WO, m
  double yaw_WO = 0.0;                     ///< of T_WO, rad, (−π, π]
  Vec3 gyroscope_bias = Vec3::Zero();      ///< rad/s
  Vec3 accelerometer_bias = Vec3::Zero();  ///< m/s²
  /// Of the position (W, m) and the rotation (W, rad), row by row.
  std::array<double, 36> pose_covariance{};
  std::array<double, 9> velocity_covariance{};  ///< W, (m/s)², row by row
  std::array<double, 9> drift_covariance{};     ///< of the position relative to that of one second ago, W, m²
  std::int32_t tracks = 0;                      ///< features in use
  std::int32_t rejected = 0;                    ///< features refused in the last frame
};

}  // namespace tern
