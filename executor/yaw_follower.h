// The yaw setpoint: it follows the direction of flight with limited rate and acceleration.
#pragma once

#include "core/base/knobs.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/heading.h"

namespace tern {

/// The section `executor.heading`. With the defaults, a vehicle of half a metre turns without losing much thrust.
struct YawFollowerConfig {
  double rate_max_deg_s = 120.0;
  double acceleration_max_deg_s2 = 360.0;
  double least_speed = 0.5;  ///< m/s

  template <typename V>
  void visit(V& v) {
    v("rate_max", rate_max_deg_s, Range{1.0, 1000.0}, "largest yaw rate, degrees/s");
    v("acceleration_max", acceleration_max_deg_s2, Range{1.0, 1e5}, "largest yaw acceleration, degrees/s²");
    v("least_speed", least_speed, Range{0.01, 100.0},
      "below this horizontal speed, m/s, the yaw keeps its last target");
  }
};

/// Turns the yaw towards the direction of horizontal flight, the shorter way round. It turns as fast as the limits of
/// rate and acceleration allow, and slows down in time to stop at its target.
///
/// For a target e rad away and a step of h s, the rate is at most the v with v²/2a + v h/2 = |e|. From this rate the
/// yaw can still stop at its target. Pure: times are arguments.
class YawFollower {
 public:
  /// Starts at `yaw` (rad) with rate 0.
  YawFollower(double yaw, UTime now, const YawFollowerConfig& config = {});

  /// Advances to `now`, where the vehicle flies at v (W, m/s). A time before the last one changes nothing.
  /// @return the yaw
  double follow(const Vec3& v, UTime now);

  /// Advances to `now`, where the planned yaw is `planned`. A heading that the yaw joins is flown exactly. Otherwise
  /// the yaw turns to it within the heading's limits. It is on the heading once one step can match yaw and rate.
  /// @return the yaw
  double follow(const YawSample& planned, UTime now, const HeadingLimits& limits);

  [[nodiscard]] double yaw() const { return yaw_; }    ///< rad, (−π, π]
  [[nodiscard]] double rate() const { return rate_; }  ///< rad/s

 private:
  double rate_max_, acceleration_max_, least_speed_;  ///< rad/s, rad/s², m/s
  double yaw_, aim_;
  double rate_ = 0.0;
  UTime at_;
};

}  // namespace tern
