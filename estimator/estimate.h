// The estimate: pose, velocity, biases and their covariance; and the troubles of its inputs.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/frames.h"
#include "core/world/inertial.h"

namespace tern {

// The first index of each error in Estimate::covariance; each error has three axes.
inline constexpr int kAttitudeError = 0;    ///< φ of R_WB = Exp(φ) R̂_WB, rad, along W's axes
inline constexpr int kPositionError = 3;    ///< p − p̂ in W, m
inline constexpr int kVelocityError = 6;    ///< v − v̂ in W, m/s
inline constexpr int kGyroBiasError = 9;    ///< rad/s, in B
inline constexpr int kAccelBiasError = 12;  ///< m/s², in B
inline constexpr int kEstimateErrors = 15;
using EstimateCovariance = Eigen::Matrix<double, kEstimateErrors, kEstimateErrors>;

/// The state of the vehicle at one time.
struct Estimate {
  UTime at;
  PoseInO pose;                    ///< of B
  VectorInO velocity;              ///< m/s
  OdometryOffset T_WO;             ///< maps pose and velocity to W
  Vec3 rate = Vec3::Zero();        ///< of B, in B, without the bias, rad/s
  VectorInO acceleration;          ///< of B, without gravity and bias, m/s²
  Vec3 gyro_bias = Vec3::Zero();   ///< rad/s, in B
  Vec3 accel_bias = Vec3::Zero();  ///< m/s², in B
  /// Of the errors of T_WO·pose, T_WO·velocity and the biases (kAttitudeError to kAccelBiasError).
  EstimateCovariance covariance = EstimateCovariance::Zero();
  /// Of the error of the acceleration by tilt and bias, W, m²/s⁴: by it the velocity's error grows while nothing is
  /// seen.
  Eigen::Matrix3d acceleration_covariance = Eigen::Matrix3d::Zero();
  /// Of the position relative to the one `drift_age` ago, W, m²: how far a thing that was seen then is misplaced now.
  Eigen::Matrix3d drift_covariance = Eigen::Matrix3d::Zero();
  Duration drift_age;    ///< about 1 s in flight, less soon after the start
  int tracks = 0;        ///< features of the newest frame that are not masked
  int rejected = 0;      ///< features that the χ² gate refused in the newest update
  Duration since_frame;  ///< since the newest frame that had features
  EstimatorState state = EstimatorState::Tracking;

  [[nodiscard]] PoseInW pose_in_W() const { return T_WO.to_W(pose); }
  [[nodiscard]] VectorInW velocity_in_W() const { return T_WO.to_W(velocity); }
};

/// A fault of an input.
enum class Trouble : std::uint8_t {
  ImuNotFinite,      ///< a sample has NaN or infinity: not used
  ImuOrder,          ///< a sample is not newer than the one before it: not used
  ImuGap,            ///< samples are missing: the gap is bridged with more noise
  ImuSaturated,      ///< a sample is at the end of its range: used with more noise
  FrameNotFinite,    ///< features with NaN or infinity, or a camera without a usable pose: these are not used
  FrameLate,         ///< a frame is older than the filter's state: not used
  FrameAhead,        ///< a frame is far newer than the IMU's newest sample: not used
  RepeatedIds,       ///< an id twice in one frame: the second is not used
  CameraStuck,       ///< frames in turn have the same coordinates: not used
  CamerasSwapped,    ///< most disparities are negative: the frame is not used
  TracksContradict,  ///< the χ² gate refuses most features: clock, calibration or movers
  FixNotFinite,      ///< a fix has no usable position or variance: not used
  FixLate,           ///< a fix is older than all past poses: not used
  FixAhead,          ///< a fix is far newer than the IMU's newest sample: not used
  FixContradicts,    ///< the χ² gate refused a fix; of kBelievedFixes in a row that agree, the last is used
  NotAtRest,         ///< the vehicle moves, so the estimate cannot begin
};
inline constexpr int kTroubles = 16;

/// Returns what happened, why it may be, and what to do, in words: at most 150 bytes.
std::string to_text(Trouble trouble);

/// The phase of an Estimator, and what its estimate() then is.
///
/// | phase   | while                                                                 | estimate()   |
/// |---------|-----------------------------------------------------------------------|--------------|
/// | Waiting | the vehicle has not rested for EstimatorConfig::rest_s                | none         |
/// | AtRest  | it has, and still rests: biases and tilt are measured continuously    | at rest      |
/// | Moving  | it has moved, or start() gave its state                               | the filter's |
/// | Lost    | in motion no sample was usable for longer than kMaxImuGap, or σ exceeds 1 km | none       |
///
/// Only start() ends Lost, because it gives a position.
enum class EstimatorPhase : std::uint8_t { Waiting, AtRest, Moving, Lost };

struct EstimatorStatus {
  EstimatorPhase phase = EstimatorPhase::Waiting;
  std::array<std::int64_t, kTroubles> count{};  ///< by Trouble, since the start
  std::array<UTime, kTroubles> last{};          ///< the IMU's time when it happened last; meaningless if count is 0
};

/// The fate of an input. A used one may wait for the IMU's samples. A refused one has no effect; EstimatorStatus counts
/// the reason.
enum class InputOutcome : std::uint8_t { Used, Refused };

}  // namespace tern
