// Where the vehicle's nose points: until heading is planned, along the flight.
#pragma once

#include "core/base/knobs.h"
#include "core/base/time.h"
#include "core/base/types.h"

namespace tern {

/// Rate and acceleration that an airframe of half a metre turns by without losing much thrust.
struct YawFollowerConfig {
  double rate_max_deg_s = 120.0;
  double acceleration_max_deg_s2 = 360.0;
  double least_speed = 0.5;  ///< m/s

  template <typename V>
  void visit(V& v) {
    v("rate_max", rate_max_deg_s, Range{1.0, 1000.0}, "the heading turns no faster, degrees/s");
    v("acceleration_max", acceleration_max_deg_s2, Range{1.0, 1e5}, "its rate changes no faster, degrees/s²");
    v("least_speed", least_speed, Range{0.01, 100.0},
      "below this horizontal speed, m/s, the flight has no direction: the heading keeps its last aim");
  }
};

/// The heading that follows the direction of horizontal flight, the shorter way round: as quickly as rate and
/// acceleration allow, slowing down in time to stop at its aim. Pure: times are arguments.
///
/// Over a step of h s to an aim e rad away the rate is at most v with v²/2a + v h/2 = |e|, from which it can stop
/// there.
class YawFollower {
 public:
  /// At rest at yaw (rad).
  YawFollower(double yaw, UTime now, const YawFollowerConfig& config = {});

  /// Moves on to `now` (not before the last time), where the vehicle flies at v (W, m/s). @return the yaw
  double follow(const Vec3& v, UTime now);

  [[nodiscard]] double yaw() const { return yaw_; }    ///< rad, (−π, π]
  [[nodiscard]] double rate() const { return rate_; }  ///< rad/s

 private:
  double rate_max_, acceleration_max_, least_speed_;  ///< rad/s, rad/s², m/s
  double yaw_, aim_;
  double rate_ = 0.0;
  UTime at_;
};

}  // namespace tern
