// The parameters of the simulated autopilot, and the limits and gains that follow from them.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "mavlink/sim/simulated_autopilot.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kInt32 = 6, kReal32 = 9;
/// The tilt limit changes at this rate, 0.2 rad/s (MulticopterPositionControl), in degrees/s.
constexpr double kTiltSlew = 11.46;
constexpr std::array kIntegers{"COM_OBL_RC_ACT", "COM_RC_IN_MODE", "COM_RCL_EXCEPT",  "NAV_DLL_ACT",
                               "EKF2_EV_CTRL",   "EKF2_HGT_REF",   "EKF2_GPS_CTRL",   "EKF2_MAG_TYPE",
                               "EKF2_BARO_CTRL", "MC_AIRMODE",     "MPC_ACC_DECOUPLE"};

bool is_integer(const std::string& name) { return std::ranges::find(kIntegers, name) != kIntegers.end(); }

}  // namespace

std::map<std::string, double> SimulatedAutopilot::default_parameters(const SimulatedAutopilotConfig& config) {
  const double hover = 1.0 / config.quadrotor.body.thrust_to_weight;
  const EstimatorSpec& errs = config.estimator;
  const double sigma = std::max(0.03, std::hypot(errs.position_sigma_m, errs.drift_m));
  return {{"COM_OBL_RC_ACT", 0.0},   {"COM_OF_LOSS_T", 1.0},     {"MPC_XY_VEL_D_ACC", config.velocity_d},
          {"COM_RC_IN_MODE", 3.0},   {"COM_RCL_EXCEPT", 0.0},    {"NAV_DLL_ACT", 2.0},
          {"MPC_XY_VEL_MAX", 12.0},  {"MPC_Z_VEL_MAX_UP", 3.0},  {"MPC_Z_VEL_MAX_DN", 1.5},
          {"MPC_TILTMAX_AIR", 45.0}, {"MC_ROLLRATE_MAX", 220.0}, {"MC_PITCHRATE_MAX", 220.0},
          {"EKF2_EV_CTRL", 0.0},     {"EKF2_HGT_REF", 1.0},      {"EKF2_GPS_CTRL", 7.0},
          {"EKF2_MAG_TYPE", 0.0},    {"EKF2_BARO_CTRL", 1.0},    {"SIM_ARM_REFUSE", 0.0},
          {"SIM_BAT_PCT", 90.0},     {"SIM_EST_JUMP", 0.0},      {"GUID_TIMEOUT", 3.0},
          {"SIM_EV_JUMP", 8.3},      {"FS_GCS_ENABLE", 0.0},     {"SIM_HOME_UP", 0.0},
          {"SIM_ODO_SIGMA", sigma},  {"SIM_ODO_GROW", 0.0},      {"SIM_ODO_NAN", 0.0},
          {"SIM_ODO_VEL", 0.05},     {"SIM_ODO_QUAL", 0.0},      {"SIM_ODO_OFF", 0.0},
          {"MC_AIRMODE", 0.0},       {"MPC_ACC_DECOUPLE", 1.0},  {"MAV_GCS_SYSID", 255.0},
          {"ATC_ANGLE_MAX", 30.0},   {"PSC_JERK_NE", 5.0},       {"PSC_JERK_D", 5.0},
          {"GUID_OPTIONS", 0.0},     {"PSC_NE_POS_P", 1.0},      {"PSC_NE_VEL_P", 2.0},
          {"PSC_NE_VEL_I", 1.0},     {"PSC_NE_VEL_D", 0.25},     {"PSC_NE_VEL_FLTE", 5.0},
          {"PSC_NE_VEL_FLTD", 5.0},  {"ATC_INPUT_TC", 0.15},     {"WP_ACC", 2.5},
          {"WP_ACC_Z", 1.0},         {"ATC_RATE_FF_ENAB", 1.0},  {"ATC_ACC_R_MAX", 1100.0},
          {"ATC_ACC_P_MAX", 1100.0}, {"PSC_D_ACC_FLTE", 20.0},   {"MPC_TKO_RAMP_T", 3.0},
          {"MPC_TILTMAX_LND", 12.0}, {"MPC_Z_VEL_D_ACC", 0.0},   {"MPC_XY_P", 0.95},
          {"MPC_XY_VEL_P_ACC", 1.8}, {"MPC_XY_VEL_I_ACC", 0.4},  {"MC_ROLL_P", 6.5},
          {"MPC_THR_HOVER", hover},  {"MOT_THST_HOVER", hover}};
}

/// The configuration without the feed-forward, which the bridge sends.
QuadrotorConfig SimulatedAutopilot::bare(const SimulatedAutopilotConfig& config) {
  QuadrotorConfig quadrotor = config.quadrotor;
  quadrotor.controller.velocity_d = 0.0;
  quadrotor.controller.drag_per_s = quadrotor.controller.lead_s = 0.0;
  return quadrotor;
}

void SimulatedAutopilot::set_parameter(const std::string& name, double value) {
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) return;
  found->second = value;
  tune();
  if (name == "SIM_BAT_PCT") battery_ = std::clamp(value / 100.0, 0.0, 1.0);
  if (name == "SIM_EST_JUMP") model_.jump_estimate(value);
}

/// A vehicle whose owner has tuned it and knows its bounds.
void SimulatedAutopilot::take_tuned_parameters() {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const FlightControllerSpec& gains = config_.quadrotor.controller;
  parameters_["MPC_XY_P"] = gains.position_p;
  parameters_["MPC_XY_VEL_P_ACC"] = gains.velocity_p;
  parameters_["MPC_XY_VEL_I_ACC"] = gains.velocity_i;
  parameters_["MC_ROLL_P"] = gains.attitude_p;
  parameters_["MPC_TILTMAX_AIR"] = gains.tilt_max * kDegrees;
  parameters_["ATC_ANGLE_MAX"] = gains.tilt_max * kDegrees;
  parameters_["MC_ROLLRATE_MAX"] = parameters_["MC_PITCHRATE_MAX"] = gains.rate_max * kDegrees;
  for (const char* name : {"MPC_XY_VEL_MAX", "MPC_Z_VEL_MAX_UP", "MPC_Z_VEL_MAX_DN"})
    parameters_[name] = gains.speed_max;
}

/// PX4's limit is MPC_TILTMAX_LND until the take-off ramp has ended, and changes at kTiltSlew.
void SimulatedAutopilot::limit_tilt(double dt) {
  const bool flies = armed_ && ramp_since_ && ramp_ >= 1.0;
  const double limit = parameters_[is_ardupilot() ? "ATC_ANGLE_MAX" : flies ? "MPC_TILTMAX_AIR" : "MPC_TILTMAX_LND"];
  const double before = std::exchange(
      tilt_deg_, is_ardupilot() ? limit : std::clamp(limit, tilt_deg_ - kTiltSlew * dt, tilt_deg_ + kTiltSlew * dt));
  if (tilt_deg_ != before) tune();
}

void SimulatedAutopilot::tune() {
  constexpr double kRadians = std::numbers::pi / 180.0;
  FlightControllerSpec gains = bare(config_).controller;
  if (!is_ardupilot()) {
    gains.position_p = parameters_["MPC_XY_P"];
    gains.velocity_p = parameters_["MPC_XY_VEL_P_ACC"];
    gains.velocity_i = parameters_["MPC_XY_VEL_I_ACC"];
    gains.velocity_d = parameters_["MPC_XY_VEL_D_ACC"];
    gains.attitude_p = parameters_["MC_ROLL_P"];
  }
  gains.tilt_max = tilt_deg_ * kRadians;
  gains.rate_max = std::min(parameters_["MC_ROLLRATE_MAX"], parameters_["MC_PITCHRATE_MAX"]) * kRadians;
  gains.speed_max = ramp_ * std::hypot(parameters_["MPC_XY_VEL_MAX"], parameters_["MPC_Z_VEL_MAX_UP"]);
  model_.tune(gains);
}

void SimulatedAutopilot::send_parameter(const std::string& name) {
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) return;
  const bool integer = !is_ardupilot() && is_integer(name);
  const float value =
      integer ? std::bit_cast<float>(static_cast<std::int32_t>(found->second)) : static_cast<float>(found->second);
  send(ParamValue{.param_value = value,
                  .param_count = static_cast<std::uint16_t>(parameters_.size()),
                  .param_id = text_of<16>(name),
                  .param_type = integer ? kInt32 : kReal32});
}

void SimulatedAutopilot::receive_parameters(const Frame& frame) {
  if (const auto m = from_frame<ParamRequestRead>(frame); m && is_mine(m->target_system, m->target_component)) {
    send_parameter(string_of(m->param_id));
  }
  if (const auto m = from_frame<ParamSet>(frame); m && is_mine(m->target_system, m->target_component)) {
    const std::string name = string_of(m->param_id);
    const bool integer = !is_ardupilot() && is_integer(name);
    if (!is_ardupilot() && m->param_type != (integer ? kInt32 : kReal32)) return;
    set_parameter(name, integer ? std::bit_cast<std::int32_t>(m->param_value) : static_cast<double>(m->param_value));
    send_parameter(name);
  }
}

}  // namespace tern::mavlink
