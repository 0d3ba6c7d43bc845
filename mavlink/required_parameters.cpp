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

std::vector<RequiredParameter> bounds_of_px4(const UavSpec& uav) {
  const Vec3& v = uav.limits.v_max;
  const char* const clipped = "it clips faster setpoints (uav.limits.v_max)";
  std::vector<RequiredParameter> bounds{at_least("MPC_XY_VEL_MAX", v.head<2>().norm(), clipped),
                                        at_least("MPC_Z_VEL_MAX_UP", v.z(), clipped),
                                        at_least("MPC_Z_VEL_MAX_DN", v.z(), clipped)};
  const double tilt = uav.limits.dynamics ? uav.limits.dynamics->tilt_max_deg : Dynamics::kTilt.high;
  bounds.push_back(at_least("MPC_TILTMAX_AIR", tilt, "plans may tilt up to uav.dynamics.tilt_max"));
  if (!uav.limits.dynamics) return bounds;
  const char* const turned = "plans may turn up to uav.dynamics.body_rate_max";
  for (const char* name : {"MC_ROLLRATE_MAX", "MC_PITCHRATE_MAX"}) {
    bounds.push_back(at_least(name, uav.limits.dynamics->body_rate_max_deg_s, turned));
  }
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
  const double tilt = uav.limits.dynamics ? uav.limits.dynamics->tilt_max_deg : Dynamics::kTilt.high;
  std::vector<RequiredParameter> bounds{
      at_least("ANGLE_MAX", 100.0 * tilt, "plans may tilt up to uav.dynamics.tilt_max, 0.01 degrees")};
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

std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values, bool all_asked) {
  std::string faults;
  for (const RequiredParameter& r : required) {
    const auto found = values.find(r.name);
    std::string fault;
    if (found == values.end()) {
      if (r.may_be_absent && all_asked) continue;
      if (r.also_called != nullptr && values.contains(r.also_called)) continue;
      fault = fmt::format("{} was not read", r.name);
    } else if (!r.allows(found->second)) {
      const std::string range = r.bits != 0             ? fmt::format("without bits {}", r.bits)
                                : std::isfinite(r.high) ? fmt::format("not within [{:g}, {:g}]", r.low, r.high)
                                                        : fmt::format("below {:g}", r.low);
      fault = fmt::format("{} is {:g}, {}: {}", r.name, found->second, range, r.why);
    }
    if (!fault.empty()) faults += (faults.empty() ? "" : "; ") + fault;
  }
  return faults;
}

}  // namespace tern::mavlink
