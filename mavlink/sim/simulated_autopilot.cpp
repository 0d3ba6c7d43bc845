#include "mavlink/sim/simulated_autopilot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "mavlink/autopilot.h"
#include "mavlink/axes.h"

namespace tern::mavlink {
namespace {

constexpr Address kSelf{1, 1};
constexpr std::uint8_t kRejected = 1, kDenied = 2, kUnsupported = 3;
constexpr std::uint8_t kInt32 = 6, kReal32 = 9;
constexpr Duration kOldTarget{500'000}, kStreamFirst{500'000}, kDisarmAfter{1'000'000};
constexpr double kDescend = 0.7, kStop = 4.0;
/// Of the place on a map where it stands, 1e-7 degrees and mm.
constexpr std::int32_t kLatitude = 473977418, kLongitude = 85455938, kAltitude = 488'000;
constexpr std::array kIntegers{"COM_OBL_RC_ACT", "COM_RC_IN_MODE", "COM_RCL_EXCEPT", "NAV_DLL_ACT", "SIM_ARM_REFUSE"};

bool is_integer(const std::string& name) {
  return std::find(kIntegers.begin(), kIntegers.end(), name) != kIntegers.end();
}

std::array<float, 3> rates_frd(const Vec3& w) {
  return {static_cast<float>(w.x()), static_cast<float>(-w.y()), static_cast<float>(-w.z())};
}

/// Without the feed-forward that a bridge sends.
QuadrotorConfig bare(const SimulatedAutopilotConfig& config) {
  QuadrotorConfig quadrotor = config.quadrotor;
  quadrotor.controller.velocity_d = config.velocity_d;
  quadrotor.controller.drag_per_s = quadrotor.controller.lead_s = 0.0;
  return quadrotor;
}

}  // namespace

SimulatedAutopilot::SimulatedAutopilot(const SimulatedAutopilotConfig& config, std::uint64_t seed, UTime now)
    : config_(config),
      model_(bare(config), config.wind, config.estimator, seed, Vec3::Zero(), 0.0, now),
      started_(now),
      last_step_(now),
      parameters_{{"COM_OBL_RC_ACT", 0.0},   {"COM_OF_LOSS_T", 1.0},     {"MPC_XY_VEL_D_ACC", config.velocity_d},
                  {"COM_RC_IN_MODE", 3.0},   {"COM_RCL_EXCEPT", 0.0},    {"NAV_DLL_ACT", 2.0},
                  {"MPC_XY_VEL_MAX", 12.0},  {"MPC_Z_VEL_MAX_UP", 3.0},  {"MPC_Z_VEL_MAX_DN", 1.5},
                  {"MPC_TILTMAX_AIR", 45.0}, {"MC_ROLLRATE_MAX", 220.0}, {"MC_PITCHRATE_MAX", 220.0},
                  {"SIM_ARM_REFUSE", 0.0},   {"SIM_BAT_PCT", 90.0},      {"SIM_EST_JUMP", 0.0}} {
  model_.set_armed(false);
  tune();
  const auto every = [&](std::uint32_t id, std::int64_t us) { streams_[id] = {Duration{us}, now}; };
  every(Heartbeat::kId, 1'000'000);
  every(SysStatus::kId, 200'000);
  every(ExtendedSysState::kId, 200'000);
  every(EstimatorStatus::kId, 1'000'000);
  every(LocalPositionNed::kId, 33'333);
  every(Odometry::kId, 33'333);
  every(AttitudeQuaternion::kId, 20'000);
  every(Timesync::kId, 100'000);
}

std::uint64_t SimulatedAutopilot::clock_us(UTime now) const {
  return static_cast<std::uint64_t>(config_.clock_rate * static_cast<double>((now - started_).us));
}

template <class M>
void SimulatedAutopilot::say(const M& message) {
  out_.push_back(to_frame(message, kSelf, sequence_++));
}

void SimulatedAutopilot::complain(const std::string& words) {
  say(StatusText{.severity = 3, .text = text_of<50>(words)});
}

std::string SimulatedAutopilot::mode() const {
  switch (mode_) {
    case Mode::Position: return "POSCTL";
    case Mode::Loiter: return "AUTO.LOITER";
    case Mode::Land: return "AUTO.LAND";
    case Mode::Offboard: return "OFFBOARD";
  }
  return "";
}

std::uint32_t SimulatedAutopilot::custom_mode() const {
  const auto automatic = [](std::uint32_t sub) { return 4U << 16U | sub << 24U; };
  switch (mode_) {
    case Mode::Loiter: return automatic(3);
    case Mode::Land: return automatic(6);
    case Mode::Position: return 3U << 16U;
    case Mode::Offboard: return 6U << 16U;
  }
  return 0;
}

void SimulatedAutopilot::enter(Mode mode) {
  if (mode == mode_) return;
  mode_ = mode;
  command_ = model_.estimate();
  const Vec3 v = command_.motion.v;
  command_.motion.p += v * (v.norm() / (2.0 * kStop));
  command_.motion.v = command_.motion.a = command_.motion.j = Vec3::Zero();
}

bool SimulatedAutopilot::has_stream(UTime now) const {
  return last_target_ && now - *last_target_ < kOldTarget && now - *streaming_since_ >= kStreamFirst;
}

std::uint8_t SimulatedAutopilot::set_mode(int main, int sub, UTime now) {
  if (main == 6) {
    if (!has_stream(now)) {
      complain("Switching to Offboard is currently not available");
      return kRejected;
    }
    enter(Mode::Offboard);
    return kAccepted;
  }
  if (main == 3) enter(Mode::Position);
  if (main == 4 && sub == 3) enter(Mode::Loiter);
  if (main == 4 && sub == 6) enter(Mode::Land);
  return main == 3 || (main == 4 && (sub == 3 || sub == 6)) ? kAccepted : kUnsupported;
}

std::uint8_t SimulatedAutopilot::obey(const CommandLong& c, UTime now) {
  if (c.command == kSetMessageInterval) {
    if (!(c.param[0] >= 0.0F && c.param[0] < 1e6F && c.param[1] >= 1e3F && c.param[1] <= 1e7F)) return kDenied;
    auto& stream = streams_[static_cast<std::uint32_t>(c.param[0])];
    stream = {Duration{static_cast<std::int64_t>(c.param[1])}, stream.next};
    return kAccepted;
  }
  if (c.command == kRequestMessage) {
    if (c.param[0] != static_cast<float>(GpsGlobalOrigin::kId)) return kUnsupported;
    say(GpsGlobalOrigin{.latitude = kLatitude, .longitude = kLongitude, .altitude = kAltitude});
    return kAccepted;
  }
  if (now - started_ < config_.busy_for) return kRejected;
  if (c.command == kDoSetMode) return set_mode(static_cast<int>(c.param[1]), static_cast<int>(c.param[2]), now);
  if (c.command == kNavLand) {
    enter(Mode::Land);
    return kAccepted;
  }
  if (c.command != kArmDisarm) return kUnsupported;
  if (c.param[0] == 0.0F) {
    if (!model_.truth().on_ground) return kDenied;
    armed_ = false;
    return kAccepted;
  }
  if (parameters_["SIM_ARM_REFUSE"] != 0.0) {
    complain("Arming denied: Resolve system health failures first");
    return kRejected;
  }
  armed_ = true;
  return kAccepted;
}

void SimulatedAutopilot::hear_command(const CommandLong& command, Address from, UTime now) {
  CommandAck ack{.command = command.command, .result = obey(command, now)};
  ack.target_system = from.system;
  ack.target_component = from.component;
  answers_.push_back({now + config_.answer_after, ack});
}

void SimulatedAutopilot::hear_target(const SetPositionTargetLocalNed& target, UTime now) {
  if (target.coordinate_frame != 1 || (target.type_mask & 0x01FFU) != 0) return;
  if (!last_target_ || now - *last_target_ > kOldTarget) streaming_since_ = now;
  last_target_ = now;
  target_.motion.p = enu_of(target.p);
  target_.motion.v = enu_of(target.v);
  target_.motion.a = enu_of(target.a);
  target_.yaw = swapped_yaw(target.yaw);
}

void SimulatedAutopilot::set_parameter(const std::string& name, double value) {
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) return;
  found->second = value;
  tune();
  if (name == "SIM_BAT_PCT") battery_ = std::clamp(value / 100.0, 0.0, 1.0);
  if (name == "SIM_EST_JUMP") model_.jump_estimate(value);
}

void SimulatedAutopilot::tune() {
  constexpr double kRadians = std::numbers::pi / 180.0;
  FlightControllerSpec gains = bare(config_).controller;
  gains.tilt_max = parameters_["MPC_TILTMAX_AIR"] * kRadians;
  gains.rate_max = std::min(parameters_["MC_ROLLRATE_MAX"], parameters_["MC_PITCHRATE_MAX"]) * kRadians;
  gains.speed_max = std::hypot(parameters_["MPC_XY_VEL_MAX"], parameters_["MPC_Z_VEL_MAX_UP"]);
  model_.tune(gains);
}

void SimulatedAutopilot::say_parameter(const std::string& name) {
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) return;
  const bool integer = is_integer(name);
  const float value =
      integer ? std::bit_cast<float>(static_cast<std::int32_t>(found->second)) : static_cast<float>(found->second);
  say(ParamValue{.param_value = value,
                 .param_count = static_cast<std::uint16_t>(parameters_.size()),
                 .param_id = text_of<16>(name),
                 .param_type = integer ? kInt32 : kReal32});
}

void SimulatedAutopilot::hear(const Frame& frame, UTime now) {
  const auto mine = [](std::uint8_t system, std::uint8_t component) {
    return (system == 0 || system == kSelf.system) && (component == 0 || component == kSelf.component);
  };
  if (const auto m = from_frame<CommandLong>(frame); m && mine(m->target_system, m->target_component)) {
    hear_command(*m, frame.from, now);
  }
  if (const auto m = from_frame<SetPositionTargetLocalNed>(frame); m && mine(m->target_system, m->target_component)) {
    hear_target(*m, now);
  }
  if (const auto m = from_frame<Timesync>(frame); m && m->tc1 == 0) {
    say(Timesync{.tc1 = static_cast<std::int64_t>(clock_us(now)) * 1000, .ts1 = m->ts1});
  }
  if (const auto m = from_frame<ParamRequestRead>(frame); m && mine(m->target_system, m->target_component)) {
    say_parameter(words_of(m->param_id));
  }
  if (const auto m = from_frame<ParamSet>(frame); m && mine(m->target_system, m->target_component)) {
    const double value = m->param_type == kInt32 ? static_cast<double>(std::bit_cast<std::int32_t>(m->param_value))
                                                 : static_cast<double>(m->param_value);
    set_parameter(words_of(m->param_id), value);
    say_parameter(words_of(m->param_id));
  }
}

void SimulatedAutopilot::watch_offboard(UTime now) {
  if (mode_ != Mode::Offboard || !last_target_) return;
  if (now - *last_target_ <= Duration::from_seconds(parameters_["COM_OF_LOSS_T"])) return;
  complain("Offboard control lost");
  const int action = static_cast<int>(parameters_["COM_OBL_RC_ACT"]);
  enter(action == 4 ? Mode::Land : action == 5 ? Mode::Loiter : Mode::Position);
}

void SimulatedAutopilot::fly(UTime now) {
  for (UTime t = last_step_ + kVehicleStep; t <= now; t = t + kVehicleStep) {
    last_step_ = t;
    if (mode_ == Mode::Offboard) command_ = target_;
    if (mode_ == Mode::Land) {
      command_.motion.v = Vec3(0.0, 0.0, -kDescend);
      command_.motion.p.z() -= kDescend * kVehicleStep.seconds();
    }
    command_.at = t;
    command_.motion.j = Vec3::Zero();
    model_.command(command_);
    // On the ground rotors idle until it is told to rise.
    const bool rises = command_.motion.p.z() > model_.truth().motion.p.z() + 0.02 || command_.motion.v.z() > 0.0;
    model_.set_armed(armed_ && (!model_.truth().on_ground || (mode_ == Mode::Offboard && rises)));
    model_.advance(t);
    if (!model_.truth().on_ground || mode_ != Mode::Land || !armed_) {
      landed_since_.reset();
    } else if (!landed_since_) {
      landed_since_ = t;
    } else if (t - *landed_since_ >= kDisarmAfter) {
      armed_ = false;
    }
  }
}

void SimulatedAutopilot::say_odometry() {
  const UavState estimate = model_.estimate();
  const Eigen::Quaterniond q = swapped(model_.truth().q);
  Odometry m;
  m.time_usec = clock_us(estimate.at);
  m.p = ned_of(estimate.motion.p);
  m.q = wxyz_of(q);
  const Vec3 v = q.conjugate() * swapped(estimate.motion.v);
  m.v = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  m.rates = rates_frd(model_.truth().w);
  m.frame_id = 1;
  m.child_frame_id = 12;
  m.reset_counter = static_cast<std::uint8_t>(model_.resets());
  say(m);
}

void SimulatedAutopilot::say_truth() {
  const VehicleTruth truth = model_.truth();
  constexpr double kMetres = 6'371'000.0 * std::numbers::pi / 180.0 * 1e-7;  // per unit of latitude
  const double shrink = std::cos(kLatitude * 1e-7 * std::numbers::pi / 180.0);
  HilStateQuaternion m;
  m.q = wxyz_of(swapped(truth.q));
  m.rates = rates_frd(truth.w);
  m.lat = kLatitude + static_cast<std::int32_t>(std::lround(truth.motion.p.y() / kMetres));
  m.lon = kLongitude + static_cast<std::int32_t>(std::lround(truth.motion.p.x() / (kMetres * shrink)));
  m.alt = kAltitude + static_cast<std::int32_t>(std::lround(truth.motion.p.z() * 1e3));
  const Vec3 v = 100.0 * swapped(truth.motion.v);
  for (int k = 0; k < 3; ++k)
    m.v[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(std::lround(std::clamp(v[k], -3e4, 3e4)));
  say(m);
}

void SimulatedAutopilot::say_stream(std::uint32_t id, UTime now) {
  const UavState estimate = model_.estimate();
  const auto boot_ms = static_cast<std::uint32_t>(clock_us(estimate.at) / 1000);
  const bool on_ground = model_.truth().on_ground;
  switch (id) {
    case Heartbeat::kId:
      return say(Heartbeat{.custom_mode = custom_mode(),
                           .type = 2,
                           .autopilot = 12,
                           .base_mode = static_cast<std::uint8_t>(1 | (armed_ ? kArmedBit : 0)),
                           .system_status = static_cast<std::uint8_t>(armed_ ? 4 : 3)});
    case SysStatus::kId:
      return say(SysStatus{.voltage_battery = 15'000,
                           .battery_remaining = static_cast<std::int8_t>(std::lround(100.0 * battery_))});
    case ExtendedSysState::kId:
      return say(ExtendedSysState{.landed_state = static_cast<std::uint8_t>(on_ground ? 1 : 2)});
    case EstimatorStatus::kId:
      return say(EstimatorStatus{.time_usec = clock_us(now),
                                 .ratios = {0.1F, 0.1F, 0.1F, 0.1F, 0.0F, 0.0F},
                                 .pos_horiz_accuracy = static_cast<float>(config_.estimator.position_sigma_m),
                                 .pos_vert_accuracy = static_cast<float>(config_.estimator.position_sigma_m),
                                 .flags = 0x033F});
    case LocalPositionNed::kId:
      return say(LocalPositionNed{boot_ms, ned_of(estimate.motion.p), ned_of(estimate.motion.v)});
    case AttitudeQuaternion::kId:
      return say(AttitudeQuaternion{boot_ms, wxyz_of(swapped(model_.truth().q)), rates_frd(model_.truth().w), {}});
    case Timesync::kId: return say(Timesync{.ts1 = static_cast<std::int64_t>(clock_us(now)) * 1000});
    case Odometry::kId: return say_odometry();
    case HilStateQuaternion::kId: return say_truth();
    default: return;
  }
}

void SimulatedAutopilot::say_streams(UTime now) {
  for (auto& [id, stream] : streams_) {
    if (now < stream.next) continue;
    say_stream(id, now);
    stream.next = std::max(stream.next + stream.period, now - stream.period);
  }
  while (!answers_.empty() && answers_.front().due <= now) {
    say(answers_.front().ack);
    answers_.pop_front();
  }
}

void SimulatedAutopilot::step(UTime now) {
  watch_offboard(now);
  fly(now);
  say_streams(now);
}

}  // namespace tern::mavlink
