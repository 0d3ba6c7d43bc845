#include "mavlink/required_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tern::mavlink {

namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

/// The recommended value is rounded up to an integer, which single precision holds exactly.
RequiredParameter at_least(const char* name, double value, const char* why) {
  return {name, value, kAny, std::ceil(value), false, why};
}

/// A parameter that is only read. @param otherwise  the firmware's default
RequiredParameter only_read(const char* name, double otherwise) {
  RequiredParameter r{name, -kAny, kAny, otherwise, false, ""};
  r.may_be_absent = true;
  return r;
}

/// A bound of the vehicle that a value of the scenario must be within.
RequiredParameter vehicle_bound(const char* name, const RequiredParameter::Bound& bound) {
  const double least = bound.least();
  RequiredParameter r{name, -kAny, kAny, least, false, ""};
  r.bound = bound;
  return r;
}

/// The largest tilt of plans, degrees, and its key.
std::pair<const char*, double> tilt_of(const Limits& limits) {
  if (!limits.dynamics) return {"uav.dynamics.tilt_max (not stated)", Dynamics::kTilt.high};
  return {"uav.dynamics.tilt_max", limits.dynamics->tilt_max_deg};
}

RequiredParameter thrust_bound(const char* hover, const Dynamics& dynamics) {
  RequiredParameter r = vehicle_bound(hover, {.key = "uav.dynamics.thrust_max",
                                              .planned = dynamics.thrust_max,
                                              .scale = kGravity,
                                              .inverse = true,
                                              .writable = false});
  r.may_be_absent = true;
  return r;
}

std::vector<RequiredParameter> bounds_of_px4(const UavSpec& uav) {
  const Vec3& v = uav.limits.v_max;
  const auto [tilt_key, tilt] = tilt_of(uav.limits);
  const auto speed = [](const char* name, const char* key, double planned) {
    return vehicle_bound(name, {.key = key, .planned = planned, .advised = 1.0});
  };
  std::vector<RequiredParameter> bounds{
      speed("MPC_XY_VEL_MAX", "uav.limits.v_max (x and y together)", v.head<2>().norm()),
      speed("MPC_Z_VEL_MAX_UP", "uav.limits.v_max (z)", v.z()),
      speed("MPC_Z_VEL_MAX_DN", "uav.limits.v_max (z)", v.z()),
      vehicle_bound("MPC_TILTMAX_AIR", {.key = tilt_key, .planned = tilt})};
  if (!uav.limits.dynamics) return bounds;
  const double rate = uav.limits.dynamics->body_rate_max_deg_s;
  for (const char* name : {"MC_ROLLRATE_MAX", "MC_PITCHRATE_MAX"}) {
    bounds.push_back(vehicle_bound(name, {.key = "uav.dynamics.body_rate_max", .planned = rate}));
  }
  bounds.push_back(thrust_bound("MPC_THR_HOVER", *uav.limits.dynamics));
  return bounds;
}

/// The largest level jerk of a plan, m/s³.
double jerk_of(const Limits& limits) {
  const double per_axis = limits.j_max.head<2>().norm();
  if (!limits.dynamics) return per_axis;
  const double rate = limits.dynamics->body_rate_max_deg_s * std::numbers::pi / 180.0;
  return std::min(per_axis, rate * limits.dynamics->thrust_max);
}

/// The names of a Copter's parameter up to version 4.6 and from 4.7 on, and the older unit in newer ones.
struct Names {
  const char *until_4_6, *since_4_7;
  double unit = 1.0;
};

double read(const std::map<std::string, double>& values, const Names& names, double otherwise) {
  if (const auto newer = values.find(names.since_4_7); newer != values.end()) return newer->second;
  const auto older = values.find(names.until_4_6);
  return older == values.end() ? otherwise : older->second * names.unit;
}

/// Adds a parameter, whose values have the newer unit, under both names. A vehicle has one of them.
void add(std::vector<RequiredParameter>& required, RequiredParameter parameter, const Names& names) {
  parameter.name = names.since_4_7;
  parameter.also_called = names.until_4_6;
  required.push_back(parameter);
  std::swap(parameter.name, parameter.also_called);
  for (double* value : {&parameter.low, &parameter.high, &parameter.recommended}) *value /= names.unit;
  if (parameter.bound) parameter.bound->scale *= parameter.bound->root ? std::sqrt(names.unit) : names.unit;
  required.push_back(parameter);
}

/// In GUIDED, Copter shapes the commanded acceleration (ModeGuided::posvelaccel_control_run, AP_Math's
/// shape_pos_vel_accel_xy). Its jerk is limited to the least of (AC_PosControl::NE_set_max_speed_accel_m)
///
///     PSC_JERK_NE,  √(WP_ACC · g · ATC_ACC_MAX) / 2,
///
/// the latter only if ATC_RATE_FF_ENAB is 1 and ATC_ACC_MAX (the lesser of roll and pitch) is not 0. Vertically
/// (D_set_max_speed_accel_m) the limits are PSC_JERK_D and min(g, WP_ACC_Z) · 2πf/5, with the corner frequency f of the
/// acceleration's filter. WP_ACC is also the acceleration of a flight home, so it is a bound of the vehicle.
void add_jerk(std::vector<RequiredParameter>& required, const UavSpec& uav,
              const std::map<std::string, double>& values) {
  const char* const shaped = "it limits the commanded jerk to this, and lags metres behind faster changes, m/s3";
  const Names roll{"ATC_ACCEL_R_MAX", "ATC_ACC_R_MAX", 0.01}, pitch{"ATC_ACCEL_P_MAX", "ATC_ACC_P_MAX", 0.01};
  const Names filter{"PSC_ACCZ_FLTE", "PSC_D_ACC_FLTE"};
  constexpr double kAngularAcceleration = 1100.0, kFilter = 20.0;  // the firmware's defaults, degrees/s² and Hz
  constexpr double kRadians = std::numbers::pi / 180.0, kReserve = 0.9;
  add(required, only_read("", kAngularAcceleration), roll);
  add(required, only_read("", kAngularAcceleration), pitch);
  add(required, only_read("", kFilter), filter);
  required.push_back(only_read("ATC_RATE_FF_ENAB", 1.0));
  const double turns =
      std::min(read(values, roll, kAngularAcceleration), read(values, pitch, kAngularAcceleration)) * kRadians;
  const double hz = read(values, filter, kFilter);
  const double jerk = jerk_of(uav.limits), up = std::min(uav.limits.j_max.z(), jerk);
  const bool stated = jerk == uav.limits.j_max.head<2>().norm();
  if (std::isfinite(jerk)) {
    add(required, at_least("", jerk, shaped), {"PSC_JERK_XY", "PSC_JERK_NE"});
    const char* const key = stated ? "uav.limits.j_max (x and y together)"
                                   : "uav.limits.j_max (not stated: body_rate_max · thrust_max of uav.dynamics)";
    const RequiredParameter::Bound bound{
        .key = key, .planned = jerk, .scale = 0.5 * std::sqrt(kGravity * turns), .root = true, .advised = kReserve};
    if (turns > 0.0 && value_or(values, "ATC_RATE_FF_ENAB", 1.0) != 0.0) {
      add(required, vehicle_bound("", bound), {"WPNAV_ACCEL", "WP_ACC", 0.01});
    }
  }
  if (!std::isfinite(up)) return;
  add(required, at_least("", up, shaped), {"PSC_JERK_Z", "PSC_JERK_D"});
  if (hz <= 0.0) return;
  const RequiredParameter::Bound bound{
      .key = "uav.limits.j_max (z)", .planned = up, .scale = 2.0 * std::numbers::pi * hz / 5.0, .advised = kReserve};
  add(required, vehicle_bound("", bound), {"WPNAV_ACCEL_Z", "WP_ACC_Z", 0.01});
}

/// Gains of the level loops, and the time constant of the tilt's command, for the feed-forward.
void add_loops(std::vector<RequiredParameter>& required) {
  const CopterLoops loops;
  add(required, only_read("", loops.position_p), {"PSC_POSXY_P", "PSC_NE_POS_P"});
  add(required, only_read("", loops.velocity_p), {"PSC_VELXY_P", "PSC_NE_VEL_P"});
  add(required, only_read("", loops.velocity_i), {"PSC_VELXY_I", "PSC_NE_VEL_I"});
  add(required, only_read("", loops.velocity_d), {"PSC_VELXY_D", "PSC_NE_VEL_D"});
  add(required, only_read("", loops.error_hz), {"PSC_VELXY_FLTE", "PSC_NE_VEL_FLTE"});
  add(required, only_read("", loops.derivative_hz), {"PSC_VELXY_FLTD", "PSC_NE_VEL_FLTD"});
  required.push_back(only_read("ATC_INPUT_TC", 0.15));
}

std::vector<RequiredParameter> of_copter(const UavSpec& uav, std::uint8_t system, const char* blind,
                                         const std::map<std::string, double>& values) {
  std::vector<RequiredParameter> required{
      {"GUID_TIMEOUT", 0.2, 1.0, 0.5, false, blind},
      {"FS_GCS_ENABLE", 5, 5, 5, false, "after a loss of this link it would fly on or fly home; 5 lands"}};
  required.push_back({"GUID_OPTIONS", -kAny, kAny, 0, false, "it would not correct position or velocity (16, 32)"});
  required.back().no_bits = 16 | 32;
  required.back().may_be_absent = true;
  const double id = system;
  add(required, {"", id, id, id, false, "the bridge's HEARTBEAT would not count for FS_GCS_ENABLE"},
      {"SYSID_MYGCS", "MAV_GCS_SYSID"});
  const auto [tilt_key, tilt] = tilt_of(uav.limits);
  add(required, vehicle_bound("", {.key = tilt_key, .planned = tilt}), {"ANGLE_MAX", "ATC_ANGLE_MAX", 0.01});
  if (uav.limits.dynamics) required.push_back(thrust_bound("MOT_THST_HOVER", *uav.limits.dynamics));
  add_jerk(required, uav, values);
  add_loops(required);
  return required;
}

}  // namespace

double RequiredParameter::Bound::largest(double value) const {
  if (inverse) return scale / value;
  return scale * (root ? std::sqrt(value) : value);
}

double RequiredParameter::Bound::least() const {
  if (inverse) return scale / planned;
  const double linear = planned / scale;
  return std::ceil(root ? linear * linear : linear);
}

bool RequiredParameter::allows(double value) const {
  constexpr double kSinglePrecision = 1e-6;
  if (bound) return bound->planned <= bound->largest(value) * (1.0 + kSinglePrecision);
  const int set = bits != 0 || no_bits != 0 ? static_cast<int>(value) : 0;
  return value >= low && value <= high && (set & bits) == bits && (set & no_bits) == 0;
}

std::vector<RequiredParameter> required_parameters(Firmware firmware, const UavSpec& uav, std::uint8_t system,
                                                   bool without_remote, bool external_vision,
                                                   const std::map<std::string, double>& values) {
  const char* const blind = "for this time it flies on without setpoints, s";
  if (firmware == Firmware::ArduPilot) return of_copter(uav, system, blind, values);
  if (firmware != Firmware::Px4) return {};
  std::vector<RequiredParameter> required{
      {"COM_OBL_RC_ACT", 4, 5, 4, true, "without setpoints it would return and climb; 4 lands, 5 holds"},
      {"COM_OF_LOSS_T", 0.2, 1.0, 0.5, false, blind},
      {"MC_AIRMODE", 0, 0, 0, true, "a vehicle that turns fast at little thrust would be lifted"},
      {"MPC_ACC_DECOUPLE", 0, 0, 0, true,
       "a climbing or sinking vehicle would accelerate sideways by more or less than commanded"}};
  required.back().may_be_absent = true;
  if (without_remote) {
    required.push_back({"COM_RC_IN_MODE", 4, 4, 4, true, "without a remote control it refuses to arm"});
    required.push_back({"COM_RCL_EXCEPT", 4, 31, 7, true, "without remote control it would leave OFFBOARD (bit 2)", 4});
    required.push_back(
        {"NAV_DLL_ACT", 0, 0, 0, true, "it would act on the loss of a ground station that does not exist"});
  } else {
    required.push_back({"NAV_DLL_ACT", -kAny, kAny, 0, true, "with 0 the bridge may be a ground station"});
    required.back().may_be_absent = true;
  }
  for (const RequiredParameter& bound : bounds_of_px4(uav)) required.push_back(bound);
  for (const auto& [name, otherwise] : {std::pair{"MPC_TKO_RAMP_T", 3.0},
                                        {"MPC_TILTMAX_LND", 12.0},
                                        {"MC_ROLL_P", 6.5},
                                        {"MPC_XY_P", 0.95},
                                        {"MPC_XY_VEL_P_ACC", 1.8},
                                        {"MPC_XY_VEL_I_ACC", 0.4},
                                        {"MPC_XY_VEL_D_ACC", 0.2},
                                        {"MPC_Z_VEL_D_ACC", 0.0}}) {
    required.push_back(only_read(name, otherwise));
  }
  if (!external_vision) return required;
  const char* const seen = "its estimator must use the ODOMETRY from the bridge and no source that contradicts it";
  for (const auto& [name, value] : {std::pair{"EKF2_EV_CTRL", 15},
                                    {"EKF2_HGT_REF", 3},
                                    {"EKF2_GPS_CTRL", 0},
                                    {"EKF2_MAG_TYPE", 5},
                                    {"EKF2_BARO_CTRL", 0}}) {
    const double v = value;
    required.push_back({name, v, v, v, true, seen});
  }
  return required;
}

namespace {

/// Returns the fault of a parameter that was read: its value is not allowed.
std::string fault_of(const RequiredParameter& r, double value) {
  if (r.bound) {
    const double largest = r.bound->largest(value);
    const std::string meaning = r.bound->scale == 1.0 && !r.bound->root ? "" : fmt::format(" (allows {:.4g})", largest);
    return fmt::format("{} is {:.4g}, but {} is {:.4g}{}: {:.3g} would fit", r.bound->key, r.bound->planned, r.name,
                       value, meaning, r.bound->advised * largest);
  }
  const std::string range = r.no_bits != 0          ? fmt::format("with bits of {}", r.no_bits)
                            : r.bits != 0           ? fmt::format("without bits {}", r.bits)
                            : std::isfinite(r.high) ? fmt::format("not within [{:g}, {:g}]", r.low, r.high)
                                                    : fmt::format("below {:g}", r.low);
  return fmt::format("{} is {:g}, {}: {}", r.name, value, range, r.why);
}

/// Whether it is a fault that this parameter was not read.
bool is_missed(const RequiredParameter& r, const std::map<std::string, double>& values, bool all_asked) {
  if (r.may_be_absent && all_asked) return false;
  return r.also_called == nullptr || !values.contains(r.also_called);
}

std::string joined(const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, "; ")); }

}  // namespace

std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values, bool all_asked) {
  std::vector<std::string> faults;
  for (const RequiredParameter& r : required) {
    const auto found = values.find(r.name);
    if (found != values.end()) {
      if (!r.allows(found->second)) faults.push_back(fault_of(r, found->second));
      continue;
    }
    if (is_missed(r, values, all_asked)) faults.push_back(fmt::format("{} was not read", r.name));
  }
  return joined(faults);
}

std::string parameter_changes(const std::vector<RequiredParameter>& required,
                              const std::map<std::string, double>& values, bool raise_bounds) {
  std::vector<std::string> changes;
  for (const RequiredParameter& r : required) {
    const auto found = values.find(r.name);
    if (found == values.end()) {
      if (is_missed(r, values, true)) changes.push_back(fmt::format("{} was not read", r.name));
      continue;
    }
    if (r.allows(found->second)) continue;
    changes.push_back(r.may_be_written(raise_bounds)
                          ? fmt::format("would set {} to {:g} (it is {:g})", r.name, r.recommended, found->second)
                          : fault_of(r, found->second));
  }
  return joined(changes);
}

}  // namespace tern::mavlink
