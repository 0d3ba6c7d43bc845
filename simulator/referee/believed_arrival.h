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
/// | event                                                             | effect                              |
/// |-------------------------------------------------------------------|-------------------------------------|
/// | the setpoint rests at the goal, the vehicle believes to rest there | the wait begins, unless it has begun |
/// | the setpoint moves or is elsewhere; reset()                       | the wait ends                       |
/// | the vehicle believes to be at the goal, kWait after its beginning | it has arrived                      |
///
/// The wait does not end while the vehicle is told to stay, even if its estimate is corrected. A correction of T_WO is
/// followed at Navigation::kCorrectionSpeed, and a vehicle that holds its place reports this velocity meanwhile. It is
/// kRestSpeed, and in the dark there is nearly always a correction. The vehicle drifts, and will not come nearer.
class BelievedArrival {
 public:
  static constexpr Duration kWait{2'000'000};  ///< the referee may see the vehicle arrive meanwhile

  /// @return whether the vehicle has arrived. @param now  does not go back
  bool update(UTime now, const Vec3& goal, const MotionSample& setpoint, const MotionSample& believed);
  void reset() { since_.reset(); }

 private:
  std::optional<UTime> since_;
};

}  // namespace tern
