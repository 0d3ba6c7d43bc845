#include "mavlink/flight_stack.h"

#include <algorithm>
#include <array>
#include <limits>

namespace tern::mavlink {
namespace {

/// Time constant of the tilt if the attitude gain is unknown.
constexpr Duration kTiltLag{100'000};

/// A PX4, or a firmware that is unknown.
class LikePx4 : public FlightStack {
 public:
  [[nodiscard]] std::string mode(std::uint32_t custom) const override {
    constexpr std::array kMain{"", "MANUAL", "ALTCTL", "POSCTL", "AUTO", "ACRO", "OFFBOARD", "STABILIZED", "RATTITUDE"};
    constexpr std::array kAuto{"", ".READY", ".TAKEOFF", ".LOITER", ".MISSION", ".RTL", ".LAND", ".RTGS", ".FOLLOW"};
    const std::size_t main = custom >> 16U & 0xFFU, sub = custom >> 24U;
    if (main == 0 || main >= kMain.size()) return "mode " + std::to_string(custom);
    return std::string(kMain[main]) + (main == 4 && sub < kAuto.size() ? kAuto[sub] : "");
  }
  [[nodiscard]] CommandParams mode_command(std::uint32_t custom) const override {
    return {1, static_cast<float>(custom >> 16U & 0xFFU), static_cast<float>(custom >> 24U)};
  }
  [[nodiscard]] const char* following_mode() const override { return "OFFBOARD"; }
  [[nodiscard]] CommandParams following_command() const override { return {1, 6}; }
  [[nodiscard]] const char* landing_mode() const override { return "AUTO.LAND"; }
  [[nodiscard]] CommandParams landing_command() const override {
    constexpr float kHere = std::numeric_limits<float>::quiet_NaN();
    return {0, 0, 0, kHere, kHere, kHere, 0};
  }

  [[nodiscard]] bool takes_off_by_command() const override { return false; }
  [[nodiscard]] bool holds_setpoints() const override { return true; }
  [[nodiscard]] bool setpoints_end_failsafe() const override { return true; }
  [[nodiscard]] bool sends_integers_bytewise() const override { return true; }
};

class Px4 final : public LikePx4 {
 public:
  [[nodiscard]] bool takes_integers_bytewise() const override { return true; }
  [[nodiscard]] bool tells_ground_stations_only() const override { return true; }
  [[nodiscard]] Vec3 derivative_gain(const ParameterValues& parameters) const override {
    const double level = value_or(parameters, "MPC_XY_VEL_D_ACC", 0.2);
    return {level, level, value_or(parameters, "MPC_Z_VEL_D_ACC", 0.0)};
  }
  [[nodiscard]] std::optional<LoopGains> level_gains(const ParameterValues& parameters) const override {
    constexpr double kMissing = -1.0;
    const auto read = [&](const char* name) { return value_or(parameters, name, kMissing); };
    const LoopGains gains{read("MPC_XY_P"), read("MPC_XY_VEL_P_ACC"), read("MPC_XY_VEL_I_ACC"),
                          derivative_gain(parameters).x()};
    const bool all_read = std::min({gains.position_p, gains.velocity_p, gains.velocity_i}) >= 0.0;
    return all_read ? std::optional(gains) : std::nullopt;
  }
  /// The tilt follows its command as a first-order lag, with the gain of the attitude loop.
  [[nodiscard]] Duration tilt_lag(const ParameterValues& parameters) const override {
    constexpr double kLongest = 0.5;  // s
    const double gain = value_or(parameters, "MC_ROLL_P", 0.0);
    return gain > 0.0 ? Duration::from_seconds(std::min(1.0 / gain, kLongest)) : kTiltLag;
  }
  [[nodiscard]] Duration tilt_limited(const ParameterValues& parameters, const TiltRamp& ramp,
                                      UTime now) const override {
    const double rise = value_or(parameters, "MPC_TILTMAX_AIR", 45.0) - value_or(parameters, "MPC_TILTMAX_LND", 12.0);
    return ramp.remaining(value_or(parameters, "MPC_TKO_RAMP_T", 3.0), rise, now);
  }
};

class ArduPilot final : public FlightStack {
 public:
  [[nodiscard]] std::string mode(std::uint32_t custom) const override {
    static const std::map<std::uint32_t, const char*> kModes{
        {0, "STABILIZE"}, {1, "ACRO"}, {2, "ALT_HOLD"}, {3, "AUTO"},   {4, "GUIDED"},     {5, "LOITER"},   {6, "RTL"},
        {7, "CIRCLE"},    {9, "LAND"}, {16, "POSHOLD"}, {17, "BRAKE"}, {21, "SMART_RTL"}, {27, "AUTO_RTL"}};
    const auto found = kModes.find(custom);
    return found == kModes.end() ? "mode " + std::to_string(custom) : found->second;
  }
  [[nodiscard]] CommandParams mode_command(std::uint32_t custom) const override {
    return {1, static_cast<float>(custom)};
  }
  [[nodiscard]] const char* following_mode() const override { return "GUIDED"; }
  [[nodiscard]] CommandParams following_command() const override { return mode_command(4); }
  [[nodiscard]] const char* landing_mode() const override { return "LAND"; }
  /// It converts a place to integers, so there is no unknown one. It does not use the place.
  [[nodiscard]] CommandParams landing_command() const override { return {}; }

  [[nodiscard]] bool takes_off_by_command() const override { return true; }
  [[nodiscard]] bool holds_setpoints() const override { return false; }
  /// It stops and stays in GUIDED.
  [[nodiscard]] bool setpoints_end_failsafe() const override { return false; }
  [[nodiscard]] bool sends_integers_bytewise() const override { return false; }
  /// AC_PosControl::input_pos_vel_accel_NE_m.
  [[nodiscard]] std::optional<CopterLoops> integrating_loops(const ParameterValues& parameters) const override {
    const CopterLoops by_default;
    const auto read = [&](const std::string& name, double otherwise) {
      return value_or(parameters, "PSC_NE_" + name, value_or(parameters, older(name), otherwise));
    };
    return CopterLoops{.position_p = read("POS_P", by_default.position_p),
                       .velocity_p = read("VEL_P", by_default.velocity_p),
                       .velocity_i = read("VEL_I", by_default.velocity_i),
                       .velocity_d = read("VEL_D", by_default.velocity_d),
                       .error_hz = read("VEL_FLTE", by_default.error_hz),
                       .derivative_hz = read("VEL_FLTD", by_default.derivative_hz)};
  }
  /// AC_AttitudeControl::attitude_command_model: the commanded tilt is followed as by two first-order lags of
  /// ATC_INPUT_TC each; by one up to version 4.6, which has the older names. Then rates and rotors follow.
  [[nodiscard]] Duration tilt_lag(const ParameterValues& parameters) const override {
    constexpr double kRatesAndRotors = 0.04, kShortest = 0.02, kLongest = 0.25;  // s
    const double input = std::clamp(value_or(parameters, "ATC_INPUT_TC", 0.15), kShortest, kLongest);
    const bool is_old = parameters.contains(older("POS_P"));
    return Duration::from_seconds((is_old ? 1.0 : 2.0) * input + kRatesAndRotors);
  }
  /// It sends these on request only, and no heading in ODOMETRY.
  [[nodiscard]] std::vector<StreamRequest> streams() const override {
    return {{AttitudeQuaternion::kId, 20'000}, {LocalPositionNed::kId, 20'000}, {GlobalPositionInt::kId, 200'000}};
  }

 private:
  /// The name of a level gain up to version 4.6: PSC_POSXY_P, PSC_VELXY_I.
  static std::string older(const std::string& name) { return "PSC_" + name.substr(0, 3) + "XY" + name.substr(3); }
};

}  // namespace

double value_or(const ParameterValues& parameters, const std::string& name, double otherwise) {
  const auto found = parameters.find(name);
  return found == parameters.end() ? otherwise : found->second;
}

Vec3 FlightStack::derivative_gain(const ParameterValues& /*parameters*/) const { return Vec3::Zero(); }

std::optional<LoopGains> FlightStack::level_gains(const ParameterValues& /*parameters*/) const { return std::nullopt; }

std::optional<CopterLoops> FlightStack::integrating_loops(const ParameterValues& /*parameters*/) const {
  return std::nullopt;
}

Duration FlightStack::tilt_lag(const ParameterValues& /*parameters*/) const { return kTiltLag; }

Duration FlightStack::tilt_limited(const ParameterValues& /*parameters*/, const TiltRamp& /*ramp*/,
                                   UTime /*now*/) const {
  return {};
}

const FlightStack& flight_stack(Firmware firmware) {
  static const Px4 px4;
  static const ArduPilot ardupilot;
  static const LikePx4 unknown;
  switch (firmware) {
    case Firmware::Px4: return px4;
    case Firmware::ArduPilot: return ardupilot;
    case Firmware::Other: break;
  }
  return unknown;
}

}  // namespace tern::mavlink
