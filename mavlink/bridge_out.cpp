// The bridge's messages to the autopilot: commands, parameters, setpoints, external vision.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "mavlink/axes.h"
#include "mavlink/bridge.h"

namespace tern::mavlink {
namespace {

constexpr Duration kCommandPeriod{1'000'000}, kParameterPeriod{1'000'000}, kFirstParameterPeriod{300'000};
/// A PX4 handles no other message for about 10 ms per requested stream, so requests are rare in flight.
constexpr Duration kStreamsPeriod{2'000'000}, kStreamsPeriodInFlight{30'000'000};
/// COM_OF_LOSS_T's default, s.
constexpr double kOffboardLoss = 1.0;
/// 50 Hz.
constexpr Duration kVisionPeriod{20'000};
constexpr std::uint16_t kAllButYawRate = 0x0800;
constexpr std::uint8_t kLocalNed = 1, kInt32 = 6, kReal32 = 9, kVision = 2;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void Bridge::command(UTime now, std::uint16_t number, std::array<float, 7> param) {
  if (now < next_command_) return;
  next_command_ = now + kCommandPeriod;
  const Address to = *autopilot_.address();
  send(CommandLong{.param = param, .command = number, .target_system = to.system, .target_component = to.component});
}

void Bridge::request(std::uint16_t number, std::uint32_t message, float interval_us) {
  const Address to = autopilot_.address().value_or(Address{static_cast<std::uint8_t>(config_.system), 0});
  send(CommandLong{.param = {static_cast<float>(message), interval_us},
                   .command = number,
                   .target_system = to.system,
                   .target_component = to.component});
}

void Bridge::request_streams(UTime now) {
  if (now < next_streams_ || !autopilot_.address()) return;
  next_streams_ = now + (flies() ? kStreamsPeriodInFlight : kStreamsPeriod);
  request(kSetMessageInterval, Odometry::kId, 10'000);
  request(kSetMessageInterval, HilStateQuaternion::kId, 10'000);
  request(kSetMessageInterval, EstimatorStatus::kId, 200'000);
  request(kSetMessageInterval, ExtendedSysState::kId, 200'000);
  if (autopilot_.firmware() == Firmware::ArduPilot) {  // it sends these on request only, and no heading in ODOMETRY
    request(kSetMessageInterval, AttitudeQuaternion::kId, 20'000);
    request(kSetMessageInterval, LocalPositionNed::kId, 20'000);
    request(kSetMessageInterval, GlobalPositionInt::kId, 200'000);
  }
  request(kRequestMessage, GpsGlobalOrigin::kId);
}

void Bridge::request_parameters(UTime now) {
  if (now < next_parameters_ || !autopilot_.address()) return;
  next_parameters_ = now + (parameters_asked_ < kMaxParameterRounds ? kFirstParameterPeriod : kParameterPeriod);
  const Address to = *autopilot_.address();
  ++parameters_asked_;
  const bool writes = config_.set_parameters && !config_.list_parameters && !autopilot_.armed();
  for (const RequiredParameter& r : required()) {
    const auto known = autopilot_.parameters().find(r.name);
    const bool read = known != autopilot_.parameters().end();
    if (read && r.allows(known->second)) continue;
    if (read && writes && r.may_be_written(config_.raise_bounds)) {
      log_lines_.push_back(fmt::format("sets {} to {:g} (it was {:g})", r.name, r.recommended, known->second));
      originals_.try_emplace(r.name, Original{known->second, r.integer}).first->second.asked_back = false;
      write_parameter(r.name, r.recommended, r.integer);
    }
    send(ParamRequestRead{
        .target_system = to.system, .target_component = to.component, .param_id = text_of<16>(r.name)});
  }
}

void Bridge::write_parameter(const std::string& name, double value, bool integer) {
  const Address to = *autopilot_.address();
  const bool bytewise = integer && autopilot_.firmware() == Firmware::Px4;
  send(ParamSet{
      .param_value = bytewise ? std::bit_cast<float>(static_cast<std::int32_t>(value)) : static_cast<float>(value),
      .target_system = to.system,
      .target_component = to.component,
      .param_id = text_of<16>(name),
      .param_type = bytewise ? kInt32 : kReal32});
}

/// The autopilot answers each PARAM_SET with the new value. An original value that is known from before may be stale:
/// the answer to the write was lost, or is on its way.
void Bridge::set_back_parameters(UTime now) {
  if (originals_.empty() || now < next_parameters_ || autopilot_.armed() || !autopilot_.linked(now)) return;
  next_parameters_ = now + kFirstParameterPeriod;
  std::erase_if(originals_, [&](const auto& entry) {
    const auto& [name, original] = entry;
    return original.asked_back && autopilot_.parameter(name, original.value) == original.value;
  });
  for (auto& [name, original] : originals_) {
    log_lines_.push_back(fmt::format("sets {} back to {:g}", name, original.value));
    write_parameter(name, original.value, original.integer);
    original.asked_back = true;
  }
}

void Bridge::receive_vision(const UavState& seen) {
  UavState local = seen;
  local.motion.p -= origin_;
  send_vision(local);
}

/// The attitude is level: an estimator uses position, velocity and heading, and measures its tilt by itself.
void Bridge::send_vision(const UavState& local) {
  if (!config_.external_vision || !autopilot_.address() || local.at < sent_vision_ + kVisionPeriod) return;
  sent_vision_ = local.at;
  vision_.sent(local);
  const Eigen::Quaterniond level(Eigen::AngleAxisd(local.yaw, Vec3::UnitZ()));
  Odometry m;
  m.time_usec = static_cast<std::uint64_t>(local.at.us);
  m.p = ned_of(local.motion.p);
  m.q = wxyz_of(swapped(level));
  m.v = ned_of(local.motion.v);
  m.rates.fill(kUnknown);
  m.pose_covariance[0] = m.velocity_covariance[0] = kUnknown;
  m.frame_id = m.child_frame_id = kLocalNed;
  m.estimator_type = kVision;
  m.quality = 100;
  send(m);
}

bool Bridge::may_be_in_failsafe(UTime now) const {
  if (autopilot_.firmware() == Firmware::ArduPilot) return false;  // it stops and stays in GUIDED
  if (!flies()) return autopilot_.in_failsafe() && !ordered_by_goal_;
  return autopilot_.silence(now).seconds() > autopilot_.parameter("COM_OF_LOSS_T", kOffboardLoss);
}

/// An ArduPilot gets no setpoint before it is up: a setpoint ends its take-off, and has no effect on the ground.
bool Bridge::is_silent() const {
  if (stage_ == Stage::Landing && landing_seen_) return true;
  if (takes_off_by_command()) {
    const bool flown = stage_ == Stage::Climbing || stage_ == Stage::Following;
    return !flown && !(stage_ == Stage::Landing && streaming_since_);
  }
  return stage_ == Stage::Waiting || stage_ == Stage::Landed ||
         (stage_ == Stage::StoodBack && config_.start == Start::Arm);
}

/// PX4's velocity loop opposes the present acceleration by this share of it. An ArduPilot's loop opposes only the
/// error.
Vec3 Bridge::derivative_gain() const {
  if (autopilot_.firmware() != Firmware::Px4) return Vec3::Zero();
  const double level = autopilot_.parameter("MPC_XY_VEL_D_ACC", 0.2), up = autopilot_.parameter("MPC_Z_VEL_D_ACC", 0.0);
  return {level, level, up};
}

/// The tilt follows its command as a first-order lag, with the gain of the attitude loop.
Duration Bridge::lead() const {
  constexpr double kLead = 0.1, kLongest = 0.5;  // s
  const double gain = autopilot_.firmware() == Firmware::Px4 ? autopilot_.parameter("MC_ROLL_P", 0.0) : 0.0;
  const double lag_s = gain > 0.0 ? std::min(1.0 / gain, kLongest) : kLead;
  return Duration::from_seconds(config_.lead_s > 0.0 ? config_.lead_s : lag_s);
}

void Bridge::stream(UTime now) {
  const bool holds_blindly = stage_ == Stage::StoodBack && !(autopilot_.linked(now) && estimate_fault(now).empty());
  if (is_silent() || holds_blindly || may_be_in_failsafe(now) || now < next_target_) return;
  const Duration period = Duration::from_seconds(1.0 / config_.rate_hz);
  next_target_ = now + period;
  if (stage_ == Stage::StoodBack) hold_here(now);
  const bool following = stage_ == Stage::Following && followed_;
  if (!following && !own_) return;
  if (!streaming_since_) streaming_since_ = now;
  // A setpoint that is held for a period is right on average if it is right in the middle. An ArduPilot extrapolates.
  const Duration held = autopilot_.firmware() == Firmware::ArduPilot ? Duration{} : Duration{period.us / 2};
  const MotionSample m = following ? command_.sample(now + held) : own_->motion;
  if (following) {
    last_sent_.motion = m;
    last_sent_.yaw = command_.yaw();
  }
  const Vec3 ahead = following ? command_.acceleration_ahead(now, lead()) : m.a;
  const Vec3 v_ahead = m.v + 0.5 * lead().seconds() * (m.a + ahead);
  const Vec3 a =
      config_.acceleration_gain * (ahead + derivative_gain().cwiseProduct(m.a)) + config_.drag_per_s * v_ahead;
  if (following) identification_.sent(m.p, m.v, a);
  const Address to = *autopilot_.address();
  SetPositionTargetLocalNed target;
  target.time_boot_ms = static_cast<std::uint32_t>(autopilot_.clock().theirs_us(now).value_or(0) / 1000);
  target.p = ned_of(m.p - origin_);
  target.v = ned_of(m.v);
  target.a = ned_of(a);
  target.yaw = static_cast<float>(swapped_yaw(following ? command_.yaw() : own_->yaw));
  target.type_mask = kAllButYawRate;
  target.target_system = to.system;
  target.target_component = to.component;
  target.coordinate_frame = kLocalNed;
  send(target);
}

}  // namespace tern::mavlink
