#include "mavlink/required_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace tern::mavlink {

namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

/// Whole, so that it reads well and single precision holds it.
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
  bounds.push_back(at_least("MPC_TILTMAX_AIR", tilt, "plans may tilt as far (uav.dynamics.tilt_max)"));
  if (!uav.limits.dynamics) return bounds;
  const char* const turned = "plans may turn as fast (uav.dynamics.body_rate_max)";
  for (const char* name : {"MC_ROLLRATE_MAX", "MC_PITCHRATE_MAX"}) {
    bounds.push_back(at_least(name, uav.limits.dynamics->body_rate_max_deg_s, turned));
  }
  return bounds;
}

}  // namespace

bool RequiredParameter::allows(double value) const {
  return value >= low && value <= high && (static_cast<int>(bits != 0 ? value : 0.0) & bits) == bits;
}

std::vector<RequiredParameter> required_parameters(Firmware firmware, const UavSpec& uav, bool without_remote,
                                                   bool external_vision) {
  const char* const blind = "so long it flies on blindly when setpoints cease, s";
  if (firmware == Firmware::ArduPilot) {
    return {{"GUID_TIMEOUT", 0.2, 1.0, 0.5, false, blind},
            {"FS_GCS_ENABLE", 5, 5, 5, false, "without this link it would fly on or fly home; 5 lands"}};
  }
  if (firmware != Firmware::Px4) return {};
  std::vector<RequiredParameter> required{
      {"COM_OBL_RC_ACT", 4, 5, 4, true, "without setpoints it would return and climb; 4 lands, 5 holds"},
      {"COM_OF_LOSS_T", 0.2, 1.0, 0.5, false, blind},
      {"MC_AIRMODE", 0, 0, 0, true, "who turns fast at little thrust would be lifted"}};
  if (without_remote) {
    required.push_back({"COM_RC_IN_MODE", 4, 4, 4, true, "there is no remote control, and it would not be armed"});
    required.push_back({"COM_RCL_EXCEPT", 4, 31, 7, true, "without remote control it would leave OFFBOARD (bit 2)", 4});
    required.push_back({"NAV_DLL_ACT", 0, 0, 0, true, "there is no ground station, whose loss it would act on"});
  }
  for (const RequiredParameter& bound : bounds_of_px4(uav)) required.push_back(bound);
  if (!external_vision) return required;
  const char* const seen = "its estimator shall go by the ODOMETRY that it is told, and by nothing that contradicts it";
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
                             const std::map<std::string, double>& values) {
  std::string faults;
  for (const RequiredParameter& r : required) {
    const auto found = values.find(r.name);
    std::string fault;
    if (found == values.end()) {
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
