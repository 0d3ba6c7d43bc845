// A cascade as autopilots have it: position, velocity, attitude, body rates.
#pragma once

#include "core/splines/clamped_spline.h"
#include "simulator/vehicle/quadrotor.h"

namespace tern {

/// The section `quadrotor.controller`, with PX4's names in brackets. The gains fit both classes: torques are commanded
/// per inertia.
struct FlightControllerSpec {
  double position_p = 2.5;    ///< [MPC_XY_P, MPC_Z_P]
  double velocity_p = 5.0;    ///< [MPC_XY_VEL_P_ACC]
  double velocity_i = 2.0;    ///< [MPC_XY_VEL_I_ACC]
  double velocity_d = 0.0;    ///< [MPC_XY_VEL_D_ACC]: opposes the whole horizontal acceleration
  double attitude_p = 12.0;   ///< [MC_ROLL_P]
  double yaw_p = 2.5;         ///< [MC_YAW_P]
  double rate_p = 30.0;       ///< [MC_ROLLRATE_P over inertia]
  double tilt_max = 1.2;      ///< [MPC_TILTMAX_AIR]
  double rate_max = 12.0;     ///< [MC_ROLLRATE_MAX], about the forward axis and the axis to the left
  double yaw_rate_max = 3.5;  ///< [MC_YAWRATE_MAX]
  double speed_max = 20.0;    ///< [MPC_XY_VEL_MAX]
  double drag_per_s = 0.0;    ///< feed-forward: acceleration per commanded velocity
  double lead_s = 0.0;        ///< the commanded acceleration is that of this much later, by the commanded jerk
  template <typename V>
  void visit(V& v) {
    v("position_p", position_p, Range{0.0, 20.0}, "velocity per position error, 1/s");
    v("velocity_p", velocity_p, Range{0.0, 50.0}, "acceleration per velocity error, 1/s");
    v("velocity_i", velocity_i, Range{0.0, 50.0}, "acceleration per second of velocity error, 1/s²");
    v("velocity_d", velocity_d, Range{0.0, 2.0},
      "share of the estimated horizontal acceleration that is commanded against it");
    v("attitude_p", attitude_p, Range{0.1, 50.0}, "body rate per tilt error, 1/s");
    v("yaw_p", yaw_p, Range{0.1, 20.0}, "body rate per heading error, 1/s");
    v("rate_p", rate_p, Range{0.1, 200.0}, "angular acceleration per rate error, 1/s");
    v("tilt_max", tilt_max, Range{0.05, 1.5}, "largest commanded tilt, rad");
    v("rate_max", rate_max, Range{0.1, 50.0}, "largest commanded roll and pitch rate, rad/s");
    v("yaw_rate_max", yaw_rate_max, Range{0.1, 50.0}, "largest commanded yaw rate, rad/s");
    v("speed_max", speed_max, Range{0.1, 100.0}, "largest commanded speed, m/s");
    v("drag_per_s", drag_per_s, Range{0.0, 5.0}, "feed-forward against drag: acceleration per commanded velocity, 1/s");
    v("lead_s", lead_s, Range{0.0, 0.5},
      "how far ahead the commanded acceleration is taken, because tilting takes time, s");
  }
};

/// The command: a SETPOINT, or a place to hold.
struct FlightCommand {
  MotionSample motion;  ///< p, v, a, j in W
  double yaw = 0.0;     ///< rad
  double yaw_rate = 0.0;
};

/// The state that the controller uses.
struct FlightEstimate {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), a = Vec3::Zero();  ///< W; a = dv/dt, without gravity
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Vec3 w = Vec3::Zero();
};

/// | loop         | equation                                                                                   |
/// |--------------|--------------------------------------------------------------------------------------------|
/// | velocity     | v_c = v + position_p (p − p̂), at most speed_max                                            |
/// | acceleration | a_c = a + lead_s j + drag_per_s v + velocity_p (v_c − v̂) + I − velocity_d â_xy             |
/// | integral     | I = ∫ velocity_i (v_c − v̂), frozen while the wrench is not available                       |
/// | thrust       | m (a_c + g), tilted by at most tilt_max, within the rotors' limits; vertical has priority  |
/// | rates        | from the quaternion error of that direction, then of the heading (Brescianini, D'Andrea 2018) |
/// | torque       | J rate_p (ω_c − ω̂) + ω̂ × J ω̂                                                               |
///
/// Deterministic; the integral is its only state.
class FlightController {
 public:
  FlightController(const QuadrotorSpec& body, const FlightControllerSpec& gains) : body_(body), gains_(gains) {}
  /// Returns the rotors' commands for the next dt, s.
  Rotors update(const FlightCommand& command, const FlightEstimate& estimate, double dt);
  void reset() { integral_.setZero(); }
  void tune(const FlightControllerSpec& gains) { gains_ = gains; }
  /// Sets the integral as after a long hover that needed this acceleration (W, m/s²) against the wind.
  void trim(const Vec3& against) { integral_ = against; }

 private:
  [[nodiscard]] Vec3 commanded_acceleration(const FlightCommand& command, const FlightEstimate& estimate, double dt);
  [[nodiscard]] Vec3 thrust_for(const Vec3& acceleration) const;
  [[nodiscard]] Vec3 rates_for(const Vec3& thrust, const FlightCommand& command, const FlightEstimate& estimate) const;
  QuadrotorSpec body_;
  FlightControllerSpec gains_;
  Vec3 integral_ = Vec3::Zero();  // m/s²
};

}  // namespace tern
