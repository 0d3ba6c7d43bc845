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
  const double least = bound.inverse ? bound.scale / bound.planned : std::ceil(bound.planned / bound.scale);
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

/// In GUIDED, Copter shapes the commanded acceleration by its jerk limits (ModeGuided::posvelaccel_control_run,
/// AP_Math's shape_accel_xy). Its limits of speed and acceleration bound corrections only.
std::vector<RequiredParameter> bounds_of_copter(const UavSpec& uav) {
  const char* const shaped = "it limits the commanded jerk to this, and lags metres behind faster changes, m/s3";
  const auto [tilt_key, tilt] = tilt_of(uav.limits);
  std::vector<RequiredParameter> bounds{vehicle_bound("ANGLE_MAX", {.key = tilt_key, .planned = tilt, .scale = 0.01})};
  if (uav.limits.dynamics) bounds.push_back(thrust_bound("MOT_THST_HOVER", *uav.limits.dynamics));
  const double jerk = jerk_of(uav.limits), up = std::min(uav.limits.j_max.z(), jerk);
  if (std::isfinite(jerk)) bounds.push_back(at_least("PSC_JERK_XY", jerk, shaped));
  if (std::isfinite(up)) bounds.push_back(at_least("PSC_JERK_Z", up, shaped));
  for (RequiredParameter& bound : bounds) bound.may_be_absent = true;  // 4.7 has other names
  return bounds;
}

std::vector<RequiredParameter> of_copter(const UavSpec& uav, std::uint8_t system, const char* blind) {
  std::vector<RequiredParameter> required{
      {"GUID_TIMEOUT", 0.2, 1.0, 0.5, false, blind},
      {"FS_GCS_ENABLE", 5, 5, 5, false, "after a loss of this link it would fly on or fly home; 5 lands"}};
  for (const auto& [name, other] : {std::pair{"SYSID_MYGCS", "MAV_GCS_SYSID"}, {"MAV_GCS_SYSID", "SYSID_MYGCS"}}) {
    const double id = system;
    required.push_back({name, id, id, id, false, "the bridge's HEARTBEAT would not count for FS_GCS_ENABLE"});
    required.back().also_called = other;
  }
  for (const RequiredParameter& bound : bounds_of_copter(uav)) required.push_back(bound);
  return required;
}

}  // namespace

bool RequiredParameter::allows(double value) const {
  constexpr double kSinglePrecision = 1e-6;
  if (bound) return bound->planned <= bound->largest(value) * (1.0 + kSinglePrecision);
  return value >= low && value <= high && (static_cast<int>(bits != 0 ? value : 0.0) & bits) == bits;
}

std::vector<RequiredParameter> required_parameters(Firmware firmware, const UavSpec& uav, std::uint8_t system,
                                                   bool without_remote, bool external_vision) {
  const char* const blind = "for this time it flies on without setpoints, s";
  if (firmware == Firmware::ArduPilot) return of_copter(uav, system, blind);
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
    required.push_back({"NAV_DLL_ACT", -kAny, kAny, 0, true, "with 0 the bridge may be a ground station", 0, true});
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
    const std::string meaning = r.bound->scale == 1.0 ? "" : fmt::format(" (allows {:.4g})", largest);
    return fmt::format("{} is {:.4g}, but {} is {:.4g}{}: {:.3g} would fit", r.bound->key, r.bound->planned, r.name,
                       value, meaning, r.bound->advised * largest);
  }
  const std::string range = r.bits != 0             ? fmt::format("without bits {}", r.bits)
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
