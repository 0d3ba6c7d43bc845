// The section `mavlink` of a scenario.
#pragma once

#include "core/base/knobs.h"

namespace tern::mavlink {

/// Who begins a flight.
enum class Start {
  Pilot,  ///< a person arms, takes off and switches to OFFBOARD (GUIDED); then the bridge flies
  Arm     ///< the bridge asks for OFFBOARD, arms and climbs by itself
};

struct BridgeConfig {
  Start start = Start::Pilot;
  int system = 0;
  double rate_hz = 50.0;
  double acceleration_gain = 1.2;
  double drag_per_s = 0.3;
  double lead_s = 0.1;
  double climb_speed = 1.0;
  double reach_m = 5.0;
  double far_m = 3.0;
  double battery_start = 0.3;
  double battery_land = 0.15;
  double sigma_share = 1.0;
  bool check_parameters = true;
  bool set_parameters = false;
  bool without_remote = false;
  bool external_vision = false;

  template <typename V>
  void visit(V& v) {
    v("start", start, KnobWords<Start>{{"pilot", Start::Pilot}, {"arm", Start::Arm}},
      "`pilot`: a person arms, takes off and switches to OFFBOARD (GUIDED); `arm`: the bridge does, and climbs");
    v("system", system, Range{0, 255}, "MAVLink system id of the autopilot; 0: the first that is heard");
    v("rate_hz", rate_hz, Range{20.0, 100.0}, "setpoints per second to the autopilot");
    v("acceleration_gain", acceleration_gain, Range{0.0, 3.0},
      "on the commanded level acceleration: 1 + MPC_XY_VEL_D_ACC, whose term opposes all of it");
    v("drag_per_s", drag_per_s, Range{0.0, 5.0}, "acceleration added per commanded velocity, against drag, 1/s");
    v("lead_s", lead_s, Range{0.0, 0.5}, "the acceleration is taken this much ahead, against the lag of tilting, s");
    v("climb_speed", climb_speed, Range{0.1, 5.0}, "of the climb to `uav.start`, m/s");
    v("reach_m", reach_m, Range{0.1, 100.0}, "who stands farther from below `uav.start` does not take off, m");
    v("far_m", far_m, Range{0.1, 100.0}, "a setpoint farther than this from the vehicle is not flown, m");
    v("battery_start", battery_start, Range{0.0, 1.0}, "with less it does not take off, share");
    v("battery_land", battery_land, Range{0.0, 1.0}, "with less it lands, share");
    v("sigma_share", sigma_share, Range{0.0, 10.0}, "of the estimator's own accuracy that VEHICLE_STATUS says");
    v("check_parameters", check_parameters, "refuse to fly with parameters that docs/autopilot.md warns of");
    v("set_parameters", set_parameters, "write the recommended ones first, on the ground");
    v("without_remote", without_remote,
      "nobody holds a remote control and no ground station is there, as in simulation: parameters have to say so, too");
    v("external_vision", external_vision,
      "the autopilot is told where it is, by ODOMETRY: as a simulation says (HIL_STATE_QUATERNION), or as "
      "VEHICLE_TRUTH of "
      "a motion-capture system does");
  }
};

}  // namespace tern::mavlink
