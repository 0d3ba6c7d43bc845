// The simulated autopilot's behaviour as an ArduPilot.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mavlink/sim/simulated_autopilot.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kAccepted = 0, kFailed = 4;
/// Custom modes of Copter.
constexpr int kGuided = 4, kLoiter = 5, kLand = 9;
/// MOT_SPOOL_TIME, DISARM_DELAY.
constexpr Duration kSpoolUp{1'000'000}, kDisarmDelay{10'000'000};
constexpr double kClimbSpeed = 1.0;

}  // namespace

std::uint8_t SimulatedAutopilot::set_ardupilots_mode(int custom) {
  if (custom == kGuided) intend(Mode::Offboard);
  if (custom == kLoiter) intend(Mode::Position);
  if (custom == kLand) intend(Mode::Land);
  return custom == kGuided || custom == kLoiter || custom == kLand ? kAccepted : kFailed;
}

std::uint8_t SimulatedAutopilot::take_off(float above_home, UTime now) {
  const double to = home_up_ + static_cast<double>(above_home);
  if (!armed_ || mode_ != Mode::Offboard || !model_.truth().on_ground) return kFailed;
  if (to <= model_.estimate().motion.p.z()) return kFailed;
  takes_off_to_ = to;
  armed_since_ = now;
  command_ = model_.estimate();
  command_.motion.v = command_.motion.a = Vec3::Zero();
  return kAccepted;
}

/// On the ground the rotors idle until NAV_TAKEOFF. After kDisarmDelay the vehicle disarms.
bool SimulatedAutopilot::ardupilots_rotors_lift(UTime t) {
  if (!model_.truth().on_ground) return true;
  if (takes_off_to_) return t - armed_since_ >= kSpoolUp;
  if (mode_ != Mode::Land && t - armed_since_ > kDisarmDelay) disarm();
  return false;
}

void SimulatedAutopilot::fly_guided(UTime t) {
  if (takes_off_to_) {
    const bool lifts = t - armed_since_ >= kSpoolUp, up = command_.motion.p.z() >= *takes_off_to_;
    command_.motion.v = Vec3(0.0, 0.0, lifts && !up ? kClimbSpeed : 0.0);
    command_.motion.p.z() =
        std::min(command_.motion.p.z() + command_.motion.v.z() * kVehicleStep.seconds(), *takes_off_to_);
    return;
  }
  if (!guided_) return;
  const Duration since = t - *last_target_, timeout = Duration::from_seconds(parameters_["GUID_TIMEOUT"]);
  const double later = std::min(since, timeout).seconds();
  MotionSample setpoint = target_.motion;
  setpoint.p += later * (target_.motion.v + 0.5 * later * target_.motion.a);
  setpoint.v += later * target_.motion.a;
  if (since > timeout) setpoint.v = setpoint.a = Vec3::Zero();
  const double dt = kVehicleStep.seconds();
  const MotionSample& desired = shaper_.step(setpoint, level_shaping(), vertical_shaping(), dt);
  // The model's own level loops see no error: those of GuidedLoops are in the acceleration.
  const MotionSample estimate = model_.estimate().motion;
  command_.motion = loops_.step(desired, estimate, level_loops(), parameters_.at("ATC_INPUT_TC"), dt);
  command_.yaw = target_.yaw;
}

/// AC_PosControl's NE_set_max_speed_accel_m: the jerk is at most what the angular acceleration allows on average.
ShapingLimits SimulatedAutopilot::level_shaping() const {
  const auto value = [&](const char* name) { return parameters_.at(name); };
  const double turns = std::min(value("ATC_ACC_R_MAX"), value("ATC_ACC_P_MAX")) * std::numbers::pi / 180.0;
  ShapingLimits limits{value("WP_ACC"), value("PSC_JERK_NE")};
  if (turns <= 0.0 || value("ATC_RATE_FF_ENAB") == 0.0) return limits;
  limits.jerk = std::min(limits.jerk, 0.5 * std::sqrt(limits.acceleration * kGravity * turns));
  return limits;
}

CopterLoops SimulatedAutopilot::level_loops() const {
  const auto value = [&](const char* name) { return parameters_.at(name); };
  return {.position_p = value("PSC_NE_POS_P"),
          .velocity_p = value("PSC_NE_VEL_P"),
          .velocity_i = value("PSC_NE_VEL_I"),
          .velocity_d = value("PSC_NE_VEL_D"),
          .error_hz = value("PSC_NE_VEL_FLTE"),
          .derivative_hz = value("PSC_NE_VEL_FLTD")};
}

/// D_set_max_speed_accel_m: the jerk is at most what the filter of the acceleration lets through.
ShapingLimits SimulatedAutopilot::vertical_shaping() const {
  ShapingLimits limits{parameters_.at("WP_ACC_Z"), parameters_.at("PSC_JERK_D")};
  const double passes = 2.0 * std::numbers::pi * parameters_.at("PSC_D_ACC_FLTE") / 5.0;
  limits.jerk = std::min(limits.jerk, std::min(kGravity, limits.acceleration) * passes);
  return limits;
}

}  // namespace tern::mavlink
