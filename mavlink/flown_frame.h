// The frame that a vehicle is flown in while its estimator moves the frame of its poses.
#pragma once

#include <optional>

#include "core/world/frames.h"
#include "core/world/vehicle.h"

namespace tern::mavlink {

/// Finds by how much a reset has moved the frame of an estimator's poses. It compares the pose after the reset with the
/// one before it, carried on by velocity and rate of turning.
class FrameJumps {
 public:
  /// Takes a pose in the estimator's frame. @param reset  the estimator was reset since the pose before
  /// @return with `reset`: J with (x after the reset) = J (x before it), its epoch 0; else nullopt. nullopt as well for
  ///     the first pose
  std::optional<OdometryOffset> add(UTime at, const Vec3& p, const Vec3& v, double yaw, bool reset);

 private:
  struct Seen {
    UTime at;
    Vec3 p, v;
    double yaw = 0.0, yaw_rate = 0.0;
  };
  std::optional<Seen> last_;
};

/// Returns x ↦ second(first(x)), with the epoch of `first`.
OdometryOffset composed(const OdometryOffset& second, const OdometryOffset& first);

/// A reset of the autopilot's estimator moves its local frame under the vehicle. In the flown frame neither the vehicle
/// nor a trajectory jumps. The vehicle is led to its new place at kSpeed, with its heading at kTurn.
///
/// | left to go                  | flown()                                    |
/// |-----------------------------|--------------------------------------------|
/// | at most kMost and kMostTurn | stays where it was, and follows            |
/// | more                        | jumps to the estimate, and jumps() counts  |
///
/// All positions are those of the autopilot's local frame, shifted to W, m.
class FlownFrame {
 public:
  static constexpr double kSpeed = 0.1;                   ///< m/s, as Navigation::kCorrectionSpeed
  static constexpr double kTurn = 0.1;                    ///< rad/s
  static constexpr double kMost = 1.0, kMostTurn = 0.35;  ///< m, rad

  /// Takes an estimate. @param resets  the estimator's resets so far
  void add(const UavState& estimate, int resets);
  /// Returns an estimate in the flown frame.
  [[nodiscard]] UavState flown(UavState estimate) const;
  /// Returns a commanded motion of the flown frame in the autopilot's.
  [[nodiscard]] MotionSample commanded(const MotionSample& flown) const;
  [[nodiscard]] double commanded_yaw(double flown) const { return flown + ahead_.yaw; }
  /// Number of resets that moved flown() at once.
  [[nodiscard]] int jumps() const { return jumps_; }
  /// Distance of the newest estimate from its flown position, m.
  [[nodiscard]] double outstanding() const { return outstanding_; }

 private:
  void follow(const UavState& estimate, double dt);
  [[nodiscard]] bool is_followed() const { return ahead_.yaw == 0.0 && ahead_.translation.isZero(0.0); }

  FrameJumps frame_;
  OdometryOffset ahead_;  ///< maps the flown frame to the autopilot's
  std::optional<UTime> last_;
  int resets_ = 0, jumps_ = 0;
  double outstanding_ = 0.0;
};

}  // namespace tern::mavlink
