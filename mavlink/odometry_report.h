// MAVLink's ODOMETRY as Tern's: frames, covariances, resets, and what a sender leaves open.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/world/inertial.h"
#include "mavlink/flown_frame.h"
#include "mavlink/messages.h"

namespace tern::mavlink {

/// The values that count where ODOMETRY leaves its covariance open.
struct OdometryAssumptions {
  double sigma_m = 0.0;      ///< of the position per axis, m; 0: such a message is refused
  double sigma_rad = 0.0;    ///< of the rotation per axis, rad; 0: as above
  bool correlated = true;    ///< open correlations may have any value; false: they are 0
  double max_sigma_m = 2.0;  ///< the largest deviation of the position that is flown by, m
};

/// A covariance of position (W, m) and rotation (W, rad).
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

struct StatedPose {
  PoseCovariance covariance;
  Vec3 position_variance;  ///< per axis of W, as stated or assumed, m². No correlation counts for one axis
};

/// Returns the covariance that a message states. Its frame is north, east, down.
///
/// | in the message                        | becomes                                                                  |
/// |---------------------------------------|--------------------------------------------------------------------------|
/// | a variance that is NaN, 0 or negative | the assumed one; without one the message is refused                      |
/// | all 21 numbers                        | the same covariance, along W's axes                                      |
/// | NaN off the diagonal, as of a PX4     | 2 t_p I of the position and 2 t_θ I of the rotation                      |
/// | the same without `correlated`         | the variances of the position, and t_θ I of the rotation                 |
///
/// Each t is the sum of three variances.
/// This bounds every covariance with such variances: Var(x·p + y·θ) ≤ 2 Var(x·p) + 2 Var(y·θ), and no direction of
/// three axes has more variance than their sum. The sum is that of any axes: a PX4 states rotations about the body's.
Result<StatedPose> stated_pose(const Odometry& m, const OdometryAssumptions& assumed);

/// Turns ODOMETRY of MAVLink into that of Tern. Pure.
///
/// | in the message                                   | becomes                                                       |
/// |--------------------------------------------------|---------------------------------------------------------------|
/// | frame_id LOCAL_NED or LOCAL_FRD                  | W: the sender's origin is at `origin`, its x axis is W's y    |
/// | child_frame_id LOCAL_…, BODY_FRD, BODY_NED       | the frame of the velocity                                     |
/// | another reset_counter, a jump (estimate_jumps)   | epoch + 1: T_WO takes the jump, the pose in O stays           |
/// | quality −1; 0 of a sender that has stated others | LOST, with the last pose                                      |
/// | a message that cannot be used                    | none; after kMaxAge without a usable one fault() says why     |
///
/// **Drift.** ODOMETRY of MAVLink does not state the position's drift relative to one second ago. Per axis of W, with
/// the variances σ_p², σ_v² of the last second T, the smaller one of two bounds is taken:
///
///     4 max σ_p²                       two errors of any correlation; 16 max σ_p² if a reset lies between them
///     2 (T² mean σ_v² + Σ (−Δσ_p²)₊)   the integral of the velocity's error, and corrections. A correction by a Kalman
///                                      filter moves the position by as much variance as it takes away
///
/// A velocity whose variance is unknown leaves the first bound alone.
class OdometryReport {
 public:
  static constexpr Duration kMaxAge{300'000};       ///< as Navigation::kMaxAge
  static constexpr Duration kDriftTime{1'000'000};  ///< T
  static constexpr double kUnknownVariance = 1e6;   ///< (m/s)², of a velocity

  /// @param origin  of the sender's local frame, W, m
  OdometryReport(const OdometryAssumptions& assumed, const Vec3& origin) : assumed_(assumed) {
    offset_.translation = origin;
    origin_ = origin;
  }

  /// Takes a message. @param at  its time, our clock. It has an effect if it is newer than the last one
  void add(const Odometry& m, UTime at);
  /// Notes a message whose time is not known. @param why  in words
  void refuse(const std::string& why) { refused_ = why; }
  /// The newest usable estimate. Each `at` is published once by the caller.
  [[nodiscard]] const std::optional<tern::Odometry>& newest() const { return newest_; }
  /// Why the estimate cannot be flown by, or "".
  [[nodiscard]] std::string fault(UTime now) const;
  /// Standard deviation of the position's drift in one second, per axis of W, m; 0 before the first estimate.
  [[nodiscard]] Vec3 drift_sigma() const;

 private:
  struct Stated {
    UTime at;
    Vec3 position, taken_away;     ///< variances per axis of W, m²
    std::optional<Vec3> velocity;  ///< (m/s)²
    bool reset = false;
  };
  [[nodiscard]] std::string refusal(const Odometry& m);
  void use(const Odometry& m, UTime at, const StatedPose& stated);
  bool follow_resets(const Odometry& m, UTime at, const Vec3& p, const Vec3& v, double yaw);
  void remember(const Stated& stated);
  [[nodiscard]] Vec3 drift() const;  // variances, m²

  OdometryAssumptions assumed_;
  Vec3 origin_;
  OdometryOffset offset_;  ///< T_WO
  FrameJumps frame_;
  std::optional<std::uint8_t> reset_counter_;
  bool states_quality_ = false;
  std::optional<tern::Odometry> newest_;
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();  ///< of the newest estimate, W
  std::deque<Stated> stated_;                 ///< of the last kDriftTime
  std::string refused_;                       ///< why the newest message was not used
};

}  // namespace tern::mavlink
