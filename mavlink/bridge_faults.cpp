// The faults of which Bridge holds the inputs: estimate, parameters, setpoint.
#include <fmt/format.h>

#include "mavlink/bridge.h"

namespace tern::mavlink {

std::vector<RequiredParameter> Bridge::required() const {
  const std::uint8_t system = autopilot_.address() ? autopilot_.address()->system : 0;
  return required_parameters(autopilot_.firmware(), uav_, system, config_.without_remote, config_.external_vision,
                             autopilot_.parameters());
}

/// In flight, only parameters that were read count: a restarted bridge has not read them yet.
std::string Bridge::parameters_fault() const {
  if (!config_.check_parameters) return {};
  std::vector<RequiredParameter> table = required();
  if (is_flown()) {
    std::erase_if(table, [&](const RequiredParameter& r) { return !autopilot_.parameters().contains(r.name); });
  }
  return parameter_faults(table, autopilot_.parameters(), parameters_.all_asked());
}

std::string Bridge::not_ready(UTime now) const {
  if (std::string fault = link_fault(autopilot_, now); !fault.empty()) return fault;
  if (config_.list_parameters) {
    if (!parameters_.all_asked()) return "reads parameters";
    const std::string changes = parameter_changes(required(), autopilot_.parameters(), config_.raise_bounds);
    return "mavlink.list_parameters: " + (changes.empty() ? "nothing would be set" : changes);
  }
  if (!autopilot_.clock().ready()) return "its clock is not yet known (TIMESYNC)";
  if (std::string fault = clock_fault(autopilot_); !fault.empty()) return fault;
  if (std::string fault = estimate_fault(now); !fault.empty()) return fault;
  if (std::string fault = vision_.fault(); !fault.empty()) return fault;
  if (std::string fault = odometry_fault(now); !fault.empty()) return fault;
  if (!autopilot_.landed()) return "it does not report whether it has landed (EXTENDED_SYS_STATE)";
  return parameters_fault();
}

std::string Bridge::estimate_fault(UTime now) const {
  const auto& state = autopilot_.state();
  if (!state || now - state->at > kStateAge) return "it reports no position (ODOMETRY, LOCAL_POSITION_NED)";
  if (autopilot_.estimator() == EstimatorHealth::Lost) return "its estimator has no position (ESTIMATOR_STATUS)";
  const auto seen = vision_.newest_vision();
  const bool is_silent = config_.external_vision && !(seen && now - *seen <= kStateAge);
  return is_silent ? "there is no external vision to send (HIL_STATE_QUATERNION, VEHICLE_TRUTH)" : "";
}

std::string Bridge::odometry_fault(UTime now) const {
  return config_.odometry == OdometrySource::None ? "" : report_.fault(now);
}

std::string Bridge::why_not_following(UTime now) const {
  const Stage stage = at_.stage;
  if (stage == Stage::Waiting) {
    const std::string why = not_ready(now);
    return why.empty() ? to_string(stage) : why;
  }
  if (std::string fault = vision_.fault(); !fault.empty() && stage == Stage::Engaging) return fault;
  if (stage == Stage::Engaging && !at_.refusal.empty()) return at_.refusal;
  if (stage == Stage::Landing && !at_.refusal.empty()) return "landing: " + at_.refusal;
  if (stage != Stage::Following) return fmt::format("{}{}{}", to_string(stage), at_.why.empty() ? "" : ": ", at_.why);
  if (std::string fault = link_fault(autopilot_, now); !fault.empty()) return fault;
  if (std::string fault = estimate_fault(now); !fault.empty()) return fault;
  if (std::string fault = vision_.fault(); !fault.empty()) return fault;
  if (std::string fault = odometry_fault(now); !fault.empty()) return fault;
  if (!setpoint_received_) return "no SETPOINT was received";
  if (!setpoint_near(now)) return fmt::format("SETPOINT is more than {:g} m from the vehicle", config_.far_m);
  return tilt_fault(autopilot_, tilt_ramp_, now);
}

bool Bridge::setpoint_near(UTime now) const {
  const auto here = state();
  return here && (command_.sample(now).p - here->motion.p).norm() <= config_.far_m;
}

}  // namespace tern::mavlink
