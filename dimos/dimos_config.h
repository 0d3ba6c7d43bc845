// The section `dimos` of a scenario.
#pragma once

#include "core/base/knobs.h"
#include "dimos/velocity_command.h"

namespace tern::dimos {

/// The pose of DimOS's world in W.
struct WorldConfig {
  double x = 0.0, y = 0.0, z = 0.0, yaw_deg = 0.0;

  template <typename V>
  void visit(V& v) {
    v("x", x, Range::within(1e6), "where the origin of DimOS's world lies in W, x, m");
    v("y", y, Range::within(1e6), "the same, y");
    v("z", z, Range::within(1e6), "the same, z");
    v("yaw_deg", yaw_deg, Range::within(360.0),
      "angle from W's x axis to that of DimOS's world, degrees; 90 if that points north, as its MAVLink drone has it");
  }
};

struct DimosConfig {
  WorldConfig world;
  bool keep_height = false;
  double detection_sigma_m = 0.1;
  double detection_range_m = 0.0;
  double cloud_range_m = 0.0;
  double rate_hz = 20.0;
  FollowingGains following;

  template <typename V>
  void visit(V& v) {
    v("world", world);
    v("keep_height", keep_height, "a goal's height is that of the vehicle, as of goals that were clicked on a map");
    v("detection_sigma_m", detection_sigma_m, Range::positive(1e3),
      "standard deviation of detections without covariance, m");
    v("detection_range_m", detection_range_m, Range{0.0, 1e6}, "range of the detector, m; 0: no limit");
    v("cloud_range_m", cloud_range_m, Range{0.0, 1e6}, "range of the lidar, m; 0: no limit");
    v("rate_hz", rate_hz, Range{1.0, 100.0}, "velocities per second on cmd_vel");
    v("position_per_s", following.position_per_s, Range{0.0, 10.0},
      "cmd_vel: m/s of velocity per m between setpoint and vehicle");
    v("yaw_per_s", following.yaw_per_s, Range{0.0, 10.0}, "cmd_vel: rad/s per rad between the yaws");
    v("lead_s", following.lead_s, Range{0.0, 2.0},
      "cmd_vel: the velocity is that of this much later, because the vehicle lags behind velocities, s");
    v("far_m", following.far_m, Range{0.1, 100.0},
      "cmd_vel: a setpoint farther than this from the vehicle is not flown, m");
    v("lateral", following.lateral, KnobWords<Lateral>{{"left", Lateral::Left}, {"right", Lateral::Right}},
      "cmd_vel: the direction of a positive `linear.y`; `right` for DimOS's MAVLink drone");
  }
};

}  // namespace tern::dimos
