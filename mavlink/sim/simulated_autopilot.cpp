#include "mavlink/sim/simulated_autopilot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "mavlink/autopilot.h"
#include "mavlink/axes.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kRejected = 1, kDenied = 2, kUnsupported = 3;
constexpr std::uint8_t kGroundStation = 6;
constexpr Duration kOldTarget{500'000}, kStreamFirst{500'000}, kDisarmAfter{1'000'000};
constexpr Duration kTextsFor{2'500'000};
/// COM_SPOOLUP_TIME, COM_DISARM_PRFLT, COM_DL_LOSS_T.
constexpr Duration kSpoolUp{1'000'000}, kTakeOffPatience{10'000'000}, kLinkLoss{10'000'000};
/// Share of its speed at the beginning of the ramp.
constexpr double kRampFrom = 0.02;
constexpr double kDescend = 0.7, kStop = 4.0;
constexpr std::uint8_t kUnknownSource = 0, kNaive = 1, kVision = 2, kVio = 3, kLocalNed = 1;
/// After this long without ODOMETRY the estimator has no position (EKF2_NOAID_TOUT is longer).
constexpr Duration kVisionLoss{1'000'000};
/// After a longer gap the estimator takes external vision up anew, metres away, and corrects itself later.
constexpr Duration kVisionGap{400'000}, kVisionAway{5'000'000};

}  // namespace

SimulatedAutopilot::SimulatedAutopilot(const SimulatedAutopilotConfig& config, std::uint64_t seed, UTime now)
    : config_(config),
      model_(bare(config), config.wind, config.estimator, seed, Vec3::Zero(), 0.0, now),
      started_(now),
      last_step_(now),
      now_(now),
      parameters_(default_parameters(config)) {
  if (config.tuned) take_tuned_parameters();
  tilt_deg_ = parameters_["MPC_TILTMAX_LND"];
  model_.set_armed(false);
  tune();
  begin_streams(now);
}

/// Sends a text as PX4 does: with a tab at its end, and in chunks if it is longer than a message.
void SimulatedAutopilot::send_warning(const std::string& words) {
  constexpr std::size_t kChunk = 50;
  const bool is_heard = linked_ground_station_received_ && now_ - *linked_ground_station_received_ <= kTextsFor;
  if (!is_ardupilot() && !is_heard) return;
  const std::string text = words + "\t";
  ++text_id_;
  for (std::size_t at = 0; at < text.size(); at += kChunk) {
    send(StatusText{.severity = 3,
                    .text = text_of<kChunk>(text.substr(at)),
                    .id = text.size() < kChunk ? std::uint16_t{0} : text_id_,
                    .chunk_seq = static_cast<std::uint8_t>(at / kChunk)});
  }
}

std::string SimulatedAutopilot::mode() const {
  if (is_ardupilot()) return mode_ == Mode::Offboard ? "GUIDED" : mode_ == Mode::Land ? "LAND" : "LOITER";
  switch (mode_) {
    case Mode::Position: return "POSCTL";
    case Mode::Loiter: return "AUTO.LOITER";
    case Mode::Land: return "AUTO.LAND";
    case Mode::Offboard: return "OFFBOARD";
  }
  return "";
}

void SimulatedAutopilot::enter(Mode mode) {
  if (mode == mode_) return;
  mode_ = mode;
  takes_off_to_.reset();
  guided_ = false;
  command_ = model_.estimate();
  const Vec3 v = command_.motion.v;
  command_.motion.p += v * (v.norm() / (2.0 * kStop));
  command_.motion.v = command_.motion.a = command_.motion.j = Vec3::Zero();
}

bool SimulatedAutopilot::has_stream(UTime now) const {
  return last_target_ && now - *last_target_ < kOldTarget && now - *streaming_since_ >= kStreamFirst;
}

void SimulatedAutopilot::intend(Mode mode) {
  intended_ = mode;
  failsafe_ = false;
  if (mode != Mode::Land) after_disarming_ = mode;
  enter(mode);
}

std::uint8_t SimulatedAutopilot::set_mode(int main, int sub, UTime now) {
  if (main == 6) {
    if (armed_ && !has_stream(now)) {
      send_warning("Switching to Offboard is currently not available");
      return kRejected;
    }
    intend(Mode::Offboard);
    return kAccepted;
  }
  if (main == 3) intend(Mode::Position);
  if (main == 4 && sub == 3) intend(Mode::Loiter);
  if (main == 4 && sub == 6) intend(Mode::Land);
  return main == 3 || (main == 4 && (sub == 3 || sub == 6)) ? kAccepted : kUnsupported;
}

std::uint8_t SimulatedAutopilot::arm(UTime now) {
  bool no_ground_station = !ground_station_received_ || now - *ground_station_received_ > kLinkLoss;
  if (is_ardupilot()) no_ground_station = false;
  std::string fault;
  if (parameters_["SIM_ARM_REFUSE"] != 0.0) fault = "Preflight Fail: Accel 0 uncalibrated";
  if (!has_position(now)) fault = "Preflight Fail: ekf2 missing data";
  if (parameters_["NAV_DLL_ACT"] > 0.0 && no_ground_station) fault = "Preflight Fail: No connection to the GCS";
  const bool no_setpoints = !is_ardupilot() && mode_ == Mode::Offboard && !has_stream(now);
  if (!fault.empty() || no_setpoints || mode_ == Mode::Land) {
    if (!fault.empty()) send_warning(fault);
    send_warning("Arming denied: Resolve system health failures first");
    return kRejected;
  }
  if (!armed_) {
    armed_since_ = now;
    home_up_ = model_.estimate().motion.p.z() + parameters_["SIM_HOME_UP"];
  }
  armed_ = true;
  return kAccepted;
}

bool SimulatedAutopilot::has_position(UTime now) const {
  const auto value = [&](const char* name) { return parameters_.at(name); };
  if (is_busy(now)) return false;
  const bool sees = value("EKF2_EV_CTRL") == 15.0 && vision_received_ && now - *vision_received_ < kVisionLoss;
  return value("EKF2_GPS_CTRL") != 0.0 || sees;
}

void SimulatedAutopilot::receive_vision(const Odometry& seen, UTime now) {
  const bool known = seen.estimator_type == kUnknownSource || seen.estimator_type == kNaive ||
                     seen.estimator_type == kVision || seen.estimator_type == kVio;
  const auto finite = [](const auto& values) {
    return std::ranges::all_of(values, [](float x) { return std::isfinite(x); });
  };
  if (!known || seen.frame_id != kLocalNed || !finite(seen.p) || !finite(seen.q)) return;
  const bool was_away = armed_ && vision_received_ && now - *vision_received_ > kVisionGap;
  vision_received_ = now;
  if (!was_away || parameters_["EKF2_EV_CTRL"] != 15.0 || parameters_["EKF2_GPS_CTRL"] != 0.0) return;
  jump_up(parameters_["SIM_EV_JUMP"]);
  jumps_back_ = now + kVisionAway;
}

void SimulatedAutopilot::jump_up(double metres) {
  if (metres == 0.0) return;
  jumped_up_ += metres;
  model_.jump_estimate(Vec3(0.0, 0.0, metres));
  if (mode_ != Mode::Offboard) command_.motion.p.z() += metres;
}

void SimulatedAutopilot::disarm() {
  armed_ = false;
  ramp_since_.reset();
  landed_since_.reset();
  takes_off_to_.reset();
  if (!is_ardupilot()) intend(after_disarming_);
}

std::uint8_t SimulatedAutopilot::execute(const CommandLong& c, UTime now) {
  if (c.command == kSetMessageInterval) {
    if (!(c.param[0] >= 0.0F && c.param[0] < 1e6F && c.param[1] >= 1e3F && c.param[1] <= 1e7F)) return kDenied;
    auto& stream = streams_[static_cast<std::uint32_t>(c.param[0])];
    stream = {Duration{static_cast<std::int64_t>(c.param[1])}, stream.next};
    return kAccepted;
  }
  if (c.command == kRequestMessage) {
    if (c.param[0] == static_cast<float>(Heartbeat::kId)) {
      send_stream(Heartbeat::kId, now);
      return kAccepted;
    }
    if (c.param[0] != static_cast<float>(GpsGlobalOrigin::kId)) return kUnsupported;
    if (parameters_["EKF2_GPS_CTRL"] == 0.0) return kDenied;
    send_stream(GpsGlobalOrigin::kId, now);
    return kAccepted;
  }
  if (is_busy(now)) return kRejected;
  if (is_ardupilot() && c.command == kDoSetMode) return set_ardupilots_mode(static_cast<int>(c.param[1]));
  if (is_ardupilot() && c.command == kNavTakeoff) return take_off(c.param[6], now);
  if (c.command == kDoSetMode) return set_mode(static_cast<int>(c.param[1]), static_cast<int>(c.param[2]), now);
  if (c.command == kNavLand) {
    intend(Mode::Land);
    return kAccepted;
  }
  if (c.command != kArmDisarm) return kUnsupported;
  if (c.param[0] != 0.0F) return arm(now);
  if (!model_.truth().on_ground) return kDenied;
  disarm();
  return kAccepted;
}

void SimulatedAutopilot::receive_command(const CommandLong& command, Address from, UTime now) {
  CommandAck ack{.command = command.command, .result = execute(command, now)};
  ack.target_system = from.system;
  ack.target_component = from.component;
  answers_.push_back({now + config_.answer_after, ack});
}

void SimulatedAutopilot::receive_target(const SetPositionTargetLocalNed& target, UTime now) {
  if (target.coordinate_frame != 1 || (target.type_mask & 0x01FFU) != 0) return;
  if (!last_target_ || now - *last_target_ > kOldTarget) streaming_since_ = now;
  last_target_ = now;
  if (mode_ == Mode::Offboard) {
    takes_off_to_.reset();
    if (!guided_) {
      shaper_.restart(model_.estimate().motion);
      loops_.restart();
    }
    guided_ = true;
  }
  target_.motion.p = enu_of(target.p);
  target_.motion.v = enu_of(target.v);
  target_.motion.a = enu_of(target.a);
  target_.yaw = swapped_yaw(target.yaw);
}

void SimulatedAutopilot::receive(const Frame& frame, UTime now, bool on_its_link) {
  now_ = now;
  if (const auto m = from_frame<Heartbeat>(frame); m && m->type == kGroundStation) {
    ground_station_received_ = now;
    if (on_its_link) linked_ground_station_received_ = now;
  }
  if (const auto m = from_frame<CommandLong>(frame)) {
    const bool to_all = m->command == kRequestMessage && m->target_system == 0;
    if (to_all || is_mine(m->target_system, m->target_component)) receive_command(*m, frame.from, now);
  }
  if (const auto m = from_frame<SetPositionTargetLocalNed>(frame)) {
    if (m->target_system == 0 || is_mine(m->target_system, m->target_component)) receive_target(*m, now);
  }
  if (const auto m = from_frame<Odometry>(frame)) receive_vision(*m, now);
  if (const auto m = from_frame<Timesync>(frame); m && m->tc1 == 0) {
    send(Timesync{.tc1 = static_cast<std::int64_t>(clock_us(now)) * 1000, .ts1 = m->ts1});
  }
  receive_parameters(frame);
}

void SimulatedAutopilot::watch_offboard(UTime now) {
  if (is_ardupilot() || !armed_ || intended_ != Mode::Offboard || !last_target_) return;
  const bool lost = now - *last_target_ > Duration::from_seconds(parameters_["COM_OF_LOSS_T"]);
  if (lost == failsafe_) return;
  failsafe_ = lost;
  if (!lost) return enter(Mode::Offboard);
  send_warning("Failsafe activated");
  const int action = static_cast<int>(parameters_["COM_OBL_RC_ACT"]);
  enter(action == 4 ? Mode::Land : action == 5 ? Mode::Loiter : Mode::Position);
}

/// On the ground the rotors idle until they have spun up and the setpoint is above the vehicle. Then the speed ramps
/// up.
bool SimulatedAutopilot::rotors_lift(UTime t) {
  if (!armed_) return false;
  if (is_ardupilot()) return ardupilots_rotors_lift(t);
  if (ramp_since_) {
    const double progress = std::min((t - *ramp_since_).seconds() / std::max(parameters_["MPC_TKO_RAMP_T"], 1e-3), 1.0);
    if (ramp_ < 1.0) {
      ramp_ = std::max(progress, kRampFrom);
      tune();
    }
    return mode_ == Mode::Offboard || !model_.truth().on_ground;
  }
  const bool rises = command_.motion.p.z() > model_.truth().motion.p.z() + 0.02 || command_.motion.v.z() > 0.0;
  if (mode_ == Mode::Offboard && rises && t - armed_since_ >= kSpoolUp) {
    ramp_since_ = t;
    ramp_ = kRampFrom;
    tune();
  } else if (t - armed_since_ > kTakeOffPatience) {
    disarm();
  }
  return false;
}

void SimulatedAutopilot::fly(UTime now) {
  for (UTime t = last_step_ + kVehicleStep; t <= now; t = t + kVehicleStep) {
    last_step_ = t;
    if (mode_ == Mode::Offboard && is_ardupilot()) {
      fly_guided(t);
    } else if (mode_ == Mode::Offboard) {
      command_ = target_;
    }
    if (mode_ == Mode::Land) {
      command_.motion.v = Vec3(0.0, 0.0, -kDescend);
      command_.motion.p.z() -= kDescend * kVehicleStep.seconds();
    }
    command_.at = t;
    command_.motion.j = Vec3::Zero();
    model_.command(command_);
    model_.set_armed(rotors_lift(t));
    limit_tilt(kVehicleStep.seconds());
    grow_sigma(kVehicleStep.seconds());
    model_.advance(t);
    if (!model_.truth().on_ground || mode_ != Mode::Land || !armed_) {
      landed_since_.reset();
    } else if (!landed_since_) {
      landed_since_ = t;
    } else if (t - *landed_since_ >= kDisarmAfter) {
      disarm();
    }
  }
}

void SimulatedAutopilot::grow_sigma(double dt) { parameters_["SIM_ODO_SIGMA"] += dt * parameters_["SIM_ODO_GROW"]; }

void SimulatedAutopilot::step(UTime now) {
  now_ = now;
  if (jumps_back_ && now >= *jumps_back_) {
    jumps_back_.reset();
    jump_up(-jumped_up_);
  }
  watch_offboard(now);
  fly(now);
  send_streams(now);
}

}  // namespace tern::mavlink
