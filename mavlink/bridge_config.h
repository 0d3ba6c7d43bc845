// The section `mavlink` of a scenario.
#pragma once

#include "core/base/knobs.h"

namespace tern::mavlink {

/// How a flight begins.
enum class Start {
  Pilot,  ///< a person arms, takes off and switches to OFFBOARD (GUIDED); then the bridge flies
  Arm     ///< the bridge requests OFFBOARD (GUIDED), arms and climbs
};

/// The sender that states the errors of the vehicle's pose.
enum class OdometrySource {
  None,
  Autopilot,  ///< its ODOMETRY
  Companion   ///< the ODOMETRY of another estimator, on a link of its own
};

struct BridgeConfig {
  Start start = Start::Pilot;
  int system = 0;
  double rate_hz = 50.0;
  double acceleration_gain = 1.0;
  double drag_per_s = 0.3;
  double lead_s = 0.0;
  double climb_speed = 1.0;
  double reach_m = 5.0;
  double far_m = 3.0;
  double battery_start = 0.3;
  double battery_land = 0.15;
  double sigma_share = 1.0;
  bool check_parameters = true;
  bool set_parameters = false;
  bool raise_bounds = false;
  bool list_parameters = false;
  bool without_remote = false;
  bool external_vision = false;
  double vision_apart_m = 1.0;
  OdometrySource odometry = OdometrySource::None;
  double odometry_sigma_m = 0.0;
  double odometry_sigma_deg = 0.0;
  bool odometry_correlated = true;
  double odometry_max_sigma_m = 2.0;

  template <typename V>
  void visit(V& v) {
    v("start", start, KnobWords<Start>{{"pilot", Start::Pilot}, {"arm", Start::Arm}},
      "`pilot`: a person arms, takes off and switches to OFFBOARD (GUIDED); `arm`: the bridge does, and climbs");
    v("system", system, Range{0, 255}, "MAVLink system id of the autopilot; 0: that of the first HEARTBEAT");
    v("rate_hz", rate_hz, Range{20.0, 100.0}, "setpoints per second to the autopilot");
    v("acceleration_gain", acceleration_gain, Range{0.0, 3.0},
      "factor on the feed-forward of acceleration; the part that MPC_XY_VEL_D_ACC opposes is added as read from a PX4");
    v("drag_per_s", drag_per_s, Range{0.0, 5.0},
      "feed-forward against drag: acceleration per commanded velocity, 1/s; level only with an ArduPilot");
    v("lead_s", lead_s, Range{0.0, 0.5},
      "the acceleration is that of this much later, because tilting takes time, s; 0: 1/MC_ROLL_P, or from "
      "ATC_INPUT_TC");
    v("climb_speed", climb_speed, Range{0.1, 5.0}, "speed of the climb to `uav.start`, m/s");
    v("reach_m", reach_m, Range{0.1, 100.0},
      "a vehicle farther than this from the point below `uav.start` does not take off, m");
    v("far_m", far_m, Range{0.1, 100.0}, "a setpoint farther than this from the vehicle is not flown, m");
    v("battery_start", battery_start, Range{0.0, 1.0}, "smallest battery charge for a take-off, share");
    v("battery_land", battery_land, Range{0.0, 1.0}, "below this battery charge the vehicle lands, share");
    v("sigma_share", sigma_share, Range{0.0, 10.0}, "factor on the estimator's accuracy for VEHICLE_STATUS");
    v("check_parameters", check_parameters,
      "refuse to fly while the autopilot has parameters that docs/reference/autopilot.md forbids");
    v("set_parameters", set_parameters,
      "write the recommended parameters to the autopilot, on the ground; they are restored after the flight");
    v("raise_bounds", raise_bounds,
      "`set_parameters` also raises the vehicle's bounds of speed, tilt and body rate to those of the scenario");
    v("list_parameters", list_parameters,
      "a dry run: report what `set_parameters` would write and what does not fit the vehicle; do not write or fly");
    v("without_remote", without_remote,
      "there is neither a remote control nor a ground station, as in simulation; more parameters are required");
    v("external_vision", external_vision,
      "send the vehicle's position to the autopilot as ODOMETRY: from a simulation's HIL_STATE_QUATERNION, or from a "
      "motion-capture system's VEHICLE_TRUTH");
    v("vision_apart_m", vision_apart_m, Range{0.1, 100.0},
      "the autopilot's estimate may be this far from `external_vision`, level and vertically, m; beyond it the vehicle "
      "does not take off, or lands. Measured: 0.04 to 0.2 m, at most 0.6 m");
    v("odometry", odometry,
      KnobWords<OdometrySource>{{"none", OdometrySource::None},
                                {"autopilot", OdometrySource::Autopilot},
                                {"companion", OdometrySource::Companion}},
      "publish ODOMETRY with its covariance: that of the autopilot, or of another estimator at `--odometry`; "
      "`none`: the margins know no error of the estimate");
    v("odometry_sigma_m", odometry_sigma_m, Range{0.0, 100.0},
      "standard deviation of the position per axis where ODOMETRY leaves it open (NaN or 0), m; 0: it is not flown by");
    v("odometry_sigma_deg", odometry_sigma_deg, Range{0.0, 90.0},
      "standard deviation of the rotation per axis where ODOMETRY leaves it open, degrees; 0: it is not flown by");
    v("odometry_correlated", odometry_correlated,
      "correlations that ODOMETRY leaves open, as a PX4 does, may have any value: twice the sums of the "
      "variances bound them; false: they are 0");
    v("odometry_max_sigma_m", odometry_max_sigma_m, Range::positive(1000.0),
      "the vehicle does not follow while the position's standard deviation is above this, m: it comes to rest");
  }
};

}  // namespace tern::mavlink
