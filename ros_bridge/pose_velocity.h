// The velocity of a vehicle whose odometry is poses alone.
#pragma once

#include <deque>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "ros_bridge/intake.h"

namespace tern::ros {

/// The slope of the positions of the last kWindow, by least squares. It lags by half of the window: at an acceleration
/// of 2 m/s² the velocity is 0.3 m/s behind. Noise of σ at n readings becomes σ·√12 / (kWindow·√n).
class PoseVelocity {
 public:
  static constexpr Duration kWindow{300'000};
  /// The readings span at least this: two that arrive at once tell nothing.
  static constexpr Duration kLeastSpan{100'000};
  /// A position this far from the line through the previous ones is a jump; the slope begins anew, m.
  static constexpr double kJump = 0.3;

  /// Takes a reading; its velocity is not used. One that is not newer than the last one is left out.
  /// @return the velocity at the newest reading, W, m/s; nullopt until kFewestForSlope readings span kLeastSpan
  std::optional<Vec3> receive(const OdometryReading& reading);

 private:
  std::deque<OdometryReading> readings_;  ///< of the last kWindow, the newest last
};

}  // namespace tern::ros
