#include "mavlink/bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/world/flyable.h"

namespace tern::mavlink {
namespace {

constexpr Duration kHeartbeatPeriod{500'000}, kTimesyncPeriod{100'000};
/// Until the autopilot's clock is known: nothing can be flown before that.
constexpr Duration kFirstTimesyncPeriod{20'000};
/// Largest deviation of the autopilot clock's rate. A slower simulation moves in slow motion and cannot follow.
constexpr double kClockOff = 0.05;
constexpr Duration kHeld{4'000'000};
/// A lag of this size is logged, s. With a good feed-forward it is 0.01 to 0.02 s.
constexpr double kLag = 0.1;
/// Deceleration when the vehicle is taken over in flight, m/s².
constexpr double kStop = 4.0;
constexpr std::uint8_t kGroundStation = 6, kOnboardController = 18, kNoAutopilot = 8, kActive = 4;
/// `not following` says for how long, from this time on.
constexpr Duration kLong{1'000'000};
constexpr std::size_t kMaxReason = 230;  // VEHICLE_STATUS has 256 bytes for it

/// Old senders leave the target at 0.
bool is_mine(const CommandAck& ack) { return ack.target_component == 0 || ack.target_component == kOwnComponent; }

std::string seconds(Duration d) { return fmt::format("{:.1f} s", d.seconds()); }

}  // namespace

const char* to_string(Stage stage) {
  constexpr std::array kWords{"waiting",   "ready",      "engaging", "climbing",
                              "following", "stood back", "landing",  "landed"};
  return kWords.at(idx(stage));
}

Bridge::Bridge(const BridgeConfig& config, const UavSpec& uav, UTime now)
    : config_(config),
      uav_(uav),
      origin_(uav.start.x(), uav.start.y(), 0.0),
      vision_(config.vision_apart_m),
      autopilot_(static_cast<std::uint8_t>(config.system)),
      command_(uav.start, now, uav.limits),
      ordered_(config.start == Start::Arm),
      stage_since_(now),
      now_(now),
      next_heartbeat_(now),
      next_timesync_(now),
      next_target_(now),
      next_command_(now),
      next_parameters_(now),
      next_streams_(now),
      next_mode_(now) {
  if (config.external_vision) autopilot_.take_own_origin();
}

void Bridge::enter(Stage stage, const std::string& why) {
  if (stage == stage_ && why == why_) return;
  log_lines_.push_back(fmt::format("{}{}{}", to_string(stage), why.empty() ? "" : ": ", why));
  if (stage != stage_) {
    if (stage_ == Stage::Following) report_measured();
    stage_since_ = now_;
    next_command_ = now_;
    refusal_.clear();
    landing_seen_ = take_off_asked_ = false;
    if (stage == Stage::Waiting) own_.reset();
    rests_since_.reset();
    if (stage == Stage::Engaging && !found_) found_ = Found{autopilot_.mode(), autopilot_.armed()};
  }
  stage_ = stage;
  why_ = why;
}

void Bridge::stand_back(const std::string& why) {
  ordered_ = ordered_by_goal_ = followed_ = false;
  found_.reset();
  streaming_since_.reset();
  enter(Stage::StoodBack, why);
}

void Bridge::receive(const Frame& frame, UTime received) {
  if (!autopilot_.receive(frame, received)) return;
  tilt_ramp_.add(autopilot_.landed(), received);
  if (frame.id == Heartbeat::kId) watch_mode(received);
  anchor_truth_at_first_sight();
  if (autopilot_.truth()) send_vision(*autopilot_.truth());
  if (autopilot_.state()) vision_.estimated(*autopilot_.state(), autopilot_.resets());
  if (const auto question = from_frame<Timesync>(frame); question && question->tc1 == 0) {
    send(Timesync{.tc1 = received.us * 1000, .ts1 = question->ts1});
  }
  for (const CommandAck& ack : autopilot_.take_acks()) {
    const bool is_done = ack.result == kAccepted || ack.result == kInProgress;
    if (ack.command == kSetMessageInterval || ack.command == kRequestMessage || is_done || !is_mine(ack)) continue;
    refusal_ = fmt::format("{} {}", ack.command == kArmDisarm ? "arming" : fmt::format("command {}", ack.command),
                           result_text(ack.result));
    if (!autopilot_.last_warning().empty()) {
      refusal_ += ": " + autopilot_.last_warning();
    } else if (autopilot_.firmware() == Firmware::Px4 && !is_ground_station()) {
      refusal_ +=
          ": a PX4 gives the reason to ground stations alone, and NAV_DLL_ACT, which is not 0, forbids the bridge "
          "to be one";
    }
  }
  for (const std::string& text : autopilot_.take_texts()) log_lines_.push_back("autopilot: " + text);
}

void Bridge::receive(const UavState& setpoint) {
  if (setpoint_received_) return command_.receive(setpoint);
  if (now_ - setpoint.at > kSetpointSilence) return;  // of an executor that has ended
  setpoint_received_ = true;
  command_ = CommandedMotion(setpoint, uav_.limits);
}

void Bridge::order_flight() {
  if (flies()) return;
  ordered_ = ordered_by_goal_ = true;
  found_.reset();
  if (autopilot_.armed()) found_ = Found{autopilot_.mode(), true};
  forget_commanded_mode();
  if (stage_ == Stage::StoodBack || stage_ == Stage::Landed) enter(Stage::Waiting, "ordered to fly by a new GOAL");
}

void Bridge::flight_is_under_way() {
  if (!flies() && !ordered_by_goal_) ordered_ = false;
}

void Bridge::land(const std::string& why) {
  ordered_ = ordered_by_goal_ = false;
  if (stage_ == Stage::StoodBack && autopilot_.armed()) log_lines_.push_back(why + ": not landed, since " + why_);
  if (!flies() || stage_ == Stage::Landing) return;
  hold_here(now_);
  followed_ = false;
  enter(Stage::Landing, why);
  if (!autopilot_.armed() && arm_asked_ && now_ - *arm_asked_ < kCommandFlight) {
    log_lines_.push_back("the autopilot may still execute the arming request: disarming it");
  }
}

std::optional<UavState> Bridge::in_world(std::optional<UavState> local) const {
  if (local) local->motion.p += origin_;
  return local;
}

std::optional<UavState> Bridge::truth() const {
  std::optional<UavState> truth = in_world(autopilot_.truth());
  if (!truth || !truth_anchor_) return std::nullopt;
  truth->motion.p += *truth_anchor_;
  return truth;
}

void Bridge::anchor_truth() {
  if (!autopilot_.truth() || autopilot_.armed()) return;
  truth_anchor_ = autopilot_.state()->motion.p - autopilot_.truth()->motion.p;
}

void Bridge::anchor_truth_at_first_sight() {
  const auto& truth = autopilot_.truth();
  const auto& state = autopilot_.state();
  if (truth_anchor_ || !truth || !state) return;
  const double later = (truth->at - state->at).seconds();
  if (std::abs(later) > kStateAge.seconds()) return;
  truth_anchor_ = state->motion.p + state->motion.v * later - truth->motion.p;
  if (!autopilot_.armed()) return;
  log_lines_.push_back(
      "the vehicle was in flight when first seen: its truth is shifted to agree with the present estimate");
}

std::vector<RequiredParameter> Bridge::required() const {
  const std::uint8_t system = autopilot_.address() ? autopilot_.address()->system : 0;
  return required_parameters(autopilot_.firmware(), uav_, system, config_.without_remote, config_.external_vision);
}

std::vector<RequiredParameter> Bridge::required_and_read() const {
  std::vector<RequiredParameter> read = required();
  std::erase_if(read, [&](const RequiredParameter& r) { return !autopilot_.parameters().contains(r.name); });
  return read;
}

std::string Bridge::clock_fault() const {
  const double rate = autopilot_.clock().rate();
  if (std::abs(rate - 1.0) <= kClockOff) return {};
  return fmt::format(
      "the autopilot's clock runs at {:.2f} of this clock's rate: its simulation does not run in real time", rate);
}

void Bridge::watch_clock() {
  const std::string fault = clock_fault();
  if (!fault.empty() && !clock_is_off_) log_lines_.push_back(fault);
  clock_is_off_ = !fault.empty();
}

void Bridge::watch_lag() {
  const auto here = state();
  if (!here || here->at <= lag_at_) return;
  const MotionSample commanded = command_.sample(here->at);
  lag_.add(std::min((here->at - lag_at_).seconds(), 0.1), commanded.p, commanded.v, here->motion.p);
  lag_at_ = here->at;
  if (const auto gains = level_gains()) identification_.add(here->at, here->motion.p, here->motion.v, *gains);
  const double lag_s = lag_.seconds().value_or(0.0);
  if (lag_was_logged_ || std::abs(lag_s) < kLag) return;
  lag_was_logged_ = true;
  log_lines_.push_back(fmt::format(
      "the vehicle is {:.2f} s {} its setpoints: mavlink.drag_per_s is {:g}, too {} for its drag", std::abs(lag_s),
      lag_s > 0 ? "behind" : "ahead of", config_.drag_per_s, lag_s > 0 ? "small" : "large"));
}

/// Gains of a PX4 that were read, or nullopt.
std::optional<LoopGains> Bridge::level_gains() const {
  constexpr double kMissing = -1.0;
  const auto read = [&](const char* name) { return autopilot_.parameter(name, kMissing); };
  const LoopGains gains{read("MPC_XY_P"), read("MPC_XY_VEL_P_ACC"), read("MPC_XY_VEL_I_ACC"), derivative_gain().x()};
  if (std::min({gains.position_p, gains.velocity_p, gains.velocity_i}) < 0.0) return std::nullopt;
  return autopilot_.firmware() == Firmware::Px4 ? std::optional(gains) : std::nullopt;
}

void Bridge::report_measured() {
  const auto is = measured();
  if (!is) return;
  log_lines_.push_back(fmt::format(
      "measured in {:.0f} s of motion: drag {:.2f} ± {:.2f} 1/s, acceleration {:.2f} s late and {:.2f} of the "
      "commanded. For the next flight: --set mavlink.drag_per_s={:.2f} --set mavlink.lead_s={:.2f}",
      is->moved_s, is->drag_per_s, is->drag_sigma, is->lag_s, is->share, std::max(is->drag_per_s, 0.0), is->lag_s));
}

std::string Bridge::not_ready(UTime now) const {
  if (!autopilot_.address()) return "no HEARTBEAT of an autopilot was received";
  if (!autopilot_.linked(now)) return "no message from the autopilot for " + seconds(now - autopilot_.last_received());
  if (config_.list_parameters) return parameter_list();
  if (!autopilot_.clock().ready()) return "its clock is not yet known (TIMESYNC)";
  if (std::string fault = clock_fault(); !fault.empty()) return fault;
  if (std::string fault = estimate_fault(now); !fault.empty()) return fault;
  if (std::string fault = vision_.fault(); !fault.empty()) return fault;
  if (!autopilot_.landed()) return "it does not report whether it has landed (EXTENDED_SYS_STATE)";
  if (!config_.check_parameters) return {};
  const bool all_asked = parameters_asked_ >= kMaxParameterRounds;
  return parameter_faults(is_flown() ? required_and_read() : required(), autopilot_.parameters(), all_asked);
}

std::string Bridge::parameter_list() const {
  if (parameters_asked_ < kMaxParameterRounds) return "reads parameters";
  const std::string changes = parameter_changes(required(), autopilot_.parameters(), config_.raise_bounds);
  return "mavlink.list_parameters: " + (changes.empty() ? "nothing would be set" : changes);
}

std::string Bridge::estimate_fault(UTime now) const {
  const auto& state = autopilot_.state();
  if (!state || now - state->at > kStateAge) return "it reports no position (ODOMETRY, LOCAL_POSITION_NED)";
  if (autopilot_.estimator() == EstimatorHealth::Lost) return "its estimator has no position (ESTIMATOR_STATUS)";
  if (is_vision_silent(now)) return "there is no external vision to send (HIL_STATE_QUATERNION, VEHICLE_TRUTH)";
  return {};
}

bool Bridge::is_vision_silent(UTime now) const {
  const auto newest = vision_.newest_vision();
  return config_.external_vision && !(newest && now - *newest <= kStateAge);
}

/// An ArduPilot has no such limit.
std::string Bridge::tilt_fault(UTime now) const {
  if (autopilot_.firmware() != Firmware::Px4) return {};
  const double rise = autopilot_.parameter("MPC_TILTMAX_AIR", 45.0) - autopilot_.parameter("MPC_TILTMAX_LND", 12.0);
  const Duration left = tilt_ramp_.remaining(autopilot_.parameter("MPC_TKO_RAMP_T", 3.0), rise, now);
  if (left == Duration{}) return {};
  return fmt::format("its tilt is still limited after take-off, for {} (MPC_TKO_RAMP_T, MPC_TILTMAX_LND)",
                     seconds(left));
}

std::string Bridge::why_not_following(UTime now) const {
  if (stage_ == Stage::Waiting) {
    const std::string why = not_ready(now);
    return why.empty() ? to_string(stage_) : why;
  }
  if (std::string fault = vision_.fault(); !fault.empty() && stage_ == Stage::Engaging) return fault;
  if (stage_ == Stage::Engaging && !refusal_.empty()) return refusal_;
  if (stage_ == Stage::Landing && !refusal_.empty()) return "landing: " + refusal_;
  if (stage_ != Stage::Following) return fmt::format("{}{}{}", to_string(stage_), why_.empty() ? "" : ": ", why_);
  if (!autopilot_.linked(now)) return "no message from the autopilot for " + seconds(now - autopilot_.last_received());
  if (std::string fault = estimate_fault(now); !fault.empty()) return fault;
  if (std::string fault = vision_.fault(); !fault.empty()) return fault;
  if (!setpoint_received_) return "no SETPOINT was received";
  if (!setpoint_near(now)) return fmt::format("SETPOINT is more than {:g} m from the vehicle", config_.far_m);
  return tilt_fault(now);
}

std::string Bridge::beyond_last_bound(UTime now) const {
  const auto here = state();
  const Box inner = centre_box(uav_.flight_box, uav_.body);
  const Box bound(inner.min() - Vec3::Constant(kLastBound), inner.max() + Vec3::Constant(kLastBound));
  const auto text = [](const char* what, const Vec3& p) {
    return fmt::format("{} is at ({:.1f}, {:.1f}, {:.1f}) m, more than {:g} m outside uav.flight_box", what, p.x(),
                       p.y(), p.z(), kLastBound);
  };
  if (const Vec3 p = command_.sample(now).p; !bound.contains(p)) return text("SETPOINT", p);
  return here && !bound.contains(here->motion.p) ? text("the vehicle", here->motion.p) : "";
}

bool Bridge::is_ground_station() const {
  const auto action = autopilot_.parameters().find("NAV_DLL_ACT");
  return autopilot_.firmware() == Firmware::Px4 && action != autopilot_.parameters().end() && action->second == 0.0;
}

void Bridge::send_heartbeats() {
  send(Heartbeat{.type = kOnboardController, .autopilot = kNoAutopilot, .system_status = kActive});
  if (!is_ground_station()) return;
  out_.push_back(to_frame(Heartbeat{.type = kGroundStation, .autopilot = kNoAutopilot, .system_status = kActive},
                          {autopilot_.address()->system, kGroundStationComponent}, ground_station_sequence_++));
}

void Bridge::watch_following(UTime now) {
  if (!autopilot_.armed()) {
    has_followed_ = false;
    return not_following_since_.reset();
  }
  const std::string why = why_not_following(now);
  if (why.empty()) {
    if (not_following_since_) {
      log_lines_.push_back(fmt::format("follows again, after {}", seconds(now - *not_following_since_)));
    }
    has_followed_ = true;
    not_following_since_.reset();
  } else if (has_followed_ && !not_following_since_) {
    not_following_since_ = now;
    log_lines_.push_back("does not follow: " + why);
  }
}

VehicleStatus Bridge::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.armed = autopilot_.armed();
  status.why_not = why_not_following(now);
  status.following = status.armed && status.why_not.empty();
  if (!status.following && status.why_not.empty()) status.why_not = "not armed";
  status.why_not.resize(std::min(status.why_not.size(), kMaxReason));
  if (not_following_since_ && now - *not_following_since_ >= kLong) {
    status.why_not += fmt::format(" (for {:.0f} s)", (now - *not_following_since_).seconds());
  }
  status.landed = autopilot_.landed().value_or(false);
  status.mode = autopilot_.mode();
  status.battery = autopilot_.battery();
  status.estimator = autopilot_.estimator();
  status.position_sigma = config_.sigma_share * autopilot_.sigma();
  status.resets = autopilot_.resets();
  return status;
}

bool Bridge::setpoint_near(UTime now) const {
  const auto here = state();
  return here && (command_.sample(now).p - here->motion.p).norm() <= config_.far_m;
}

void Bridge::hold_here(UTime now) {
  const auto here = state();
  if (!here) return;
  const bool dead = followed_ && !estimate_fault(now).empty();  // the last command is all that is known
  own_ = dead ? last_sent_ : *here;
  MotionSample& own = own_->motion;
  own.p += own.v * (own.v.norm() / (2.0 * kStop));
  own.v = own.a = own.j = Vec3::Zero();
}

void Bridge::step(UTime now) {
  command_.settle(now - kSetpointSilence);
  command_.forget_before(now - kHeld);
  step_stage(now);
  now_ = now;
  if (now >= next_heartbeat_) {
    next_heartbeat_ = now + kHeartbeatPeriod;
    send_heartbeats();
  }
  if (now >= next_timesync_ && autopilot_.address()) {
    next_timesync_ = now + (autopilot_.clock().ready() ? kTimesyncPeriod : kFirstTimesyncPeriod);
    send(Timesync{.ts1 = now.us * 1000});
  }
  if (stage_ == Stage::Landed || ends_) set_back_parameters(now);
  if (stage_ == Stage::Following && parameters_asked_ < kMaxParameterRounds) request_parameters(now);
  request_streams(now);
  request_mode(now);
  stream(now);
  watch_following(now);
}

}  // namespace tern::mavlink
