// When a vehicle that estimates its own pose has arrived, as it believes.
#pragma once

#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/splines/clamped_spline.h"

namespace tern {

/// Judges by the vehicle's setpoint and by its believed state. *At the goal* means within kGoalRadius; *at rest* means
/// slower than kRestSpeed, as for the referee.
///
/// | event                                                               | effect                                |
/// |---------------------------------------------------------------------|---------------------------------------|
/// | the setpoint rests at the goal, the vehicle believes to rest there  | the wait begins, unless it has begun  |
/// | more than kLarge of a correction is still to come                   | kWait begins anew, up to kLongestWait |
/// | the setpoint moves or is elsewhere; reset()                         | the wait ends                         |
/// | the vehicle believes to be at the goal, kWait after its beginning   | it has arrived                        |
///
/// A correction of T_WO is followed at Navigation::kCorrectionSpeed, and a vehicle that holds its place reports this
/// velocity meanwhile. It is kRestSpeed. A large correction brings the vehicle nearer to its goal, so it is awaited: a
/// tag that came into view may correct decimetres. Without landmarks in view there is nearly always a small one.
class BelievedArrival {
 public:
  static constexpr Duration kWait{2'000'000};  ///< the referee may see the vehicle arrive meanwhile
  static constexpr Duration kLongestWait{10'000'000};
  static constexpr double kLarge = 0.05;  ///< m

  /// @return whether the vehicle has arrived. @param now  does not go back
  /// @param to_come  the part of a correction that the vehicle has still to follow, m (Navigation::outstanding())
  bool update(UTime now, const Vec3& goal, const MotionSample& setpoint, const MotionSample& believed, double to_come);
  void reset() { since_.reset(); }

 private:
  std::optional<UTime> since_;
  UTime settled_since_;  ///< with since_
};

}  // namespace tern
