#include "mavlink/bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace tern::mavlink {
namespace {

constexpr Duration kTimesyncPeriod{100'000};
/// Until the autopilot's clock is known: nothing can be flown before that.
constexpr Duration kFirstTimesyncPeriod{20'000};
constexpr Duration kHeartbeatPeriod{500'000}, kHeld{4'000'000};
constexpr std::size_t kMaxReason = 230;  // VEHICLE_STATUS has 256 bytes for it

/// Old senders leave the target at 0.
bool is_mine(const CommandAck& ack) { return ack.target_component == 0 || ack.target_component == kOwnComponent; }

OdometryAssumptions assumptions(const BridgeConfig& config) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  return {config.odometry_sigma_m, kRadians * config.odometry_sigma_deg, config.odometry_correlated,
          config.odometry_max_sigma_m};
}

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
      autopilot_(static_cast<std::uint8_t>(config.system)),
      command_(uav.start, now, uav.limits),
      now_(now),
      ordered_(config.start == Start::Arm),
      out_(static_cast<std::uint8_t>(config.system), now),
      modes_(now),
      parameters_(now),
      next_heartbeat_(now),
      next_timesync_(now),
      next_target_(now),
      next_streams_(now),
      vision_(config.vision_apart_m),
      report_(assumptions(config), origin_),
      companion_out_(static_cast<std::uint8_t>(config.system), now) {
  at_.since = now;
  if (config.external_vision) autopilot_.take_own_origin();
}

void Bridge::receive(const Frame& frame, UTime received) {
  if (!autopilot_.receive(frame, received)) return;
  out_.set_target(*autopilot_.address());
  tilt_ramp_.add(autopilot_.landed(), received);
  if (frame.id == Heartbeat::kId && modes_.watch(autopilot_, received, out_) && at_.stage != Stage::StoodBack) {
    stand_back(mode_change_reason(autopilot_, config_.without_remote));
  }
  if (truth_.see(autopilot_.state(), autopilot_.truth()) && autopilot_.armed()) {
    out_.log("the vehicle was in flight when first seen: its truth is shifted to agree with the present estimate");
  }
  if (autopilot_.truth()) send_vision(*autopilot_.truth());
  if (autopilot_.state()) vision_.estimated(*autopilot_.state(), autopilot_.resets());
  take_estimate();
  if (const auto question = from_frame<Timesync>(frame); question && question->tc1 == 0) {
    out_.send(Timesync{.tc1 = received.us * 1000, .ts1 = question->ts1});
  }
  for (const CommandAck& ack : autopilot_.take_acks()) receive_answer(ack);
  for (const std::string& text : autopilot_.take_texts()) out_.log("autopilot: " + text);
}

void Bridge::receive_answer(const CommandAck& ack) {
  const bool is_done = ack.result == kAccepted || ack.result == kInProgress;
  if (ack.command == kSetMessageInterval || ack.command == kRequestMessage || is_done || !is_mine(ack)) return;
  at_.refusal = fmt::format("{} {}", ack.command == kArmDisarm ? "arming" : fmt::format("command {}", ack.command),
                            result_text(ack.result));
  if (!autopilot_.last_warning().empty()) {
    at_.refusal += ": " + autopilot_.last_warning();
  } else if (autopilot_.stack().tells_ground_stations_only() && !is_ground_station()) {
    at_.refusal +=
        ": a PX4 gives the reason to ground stations alone, and NAV_DLL_ACT, which is not 0, forbids the bridge to be "
        "one";
  }
}

void Bridge::receive(const UavState& setpoint) {
  if (setpoint_received_) return command_.receive(setpoint);
  if (now_ - setpoint.at > kSetpointSilence) return;  // of an executor that has ended
  setpoint_received_ = true;
  command_ = CommandedMotion(setpoint, uav_.limits);
}

void Bridge::order_flight() {
  if (flies()) return;
  if (config_.start == Start::Pilot && !has_followed_) {
    return out_.log("GOAL orders no flight: with start: pilot the first one begins with the pilot's switch");
  }
  ordered_ = ordered_by_goal_ = true;
  modes_.forget_found();
  if (autopilot_.armed()) modes_.keep_found(autopilot_);
  modes_.forget();
  const bool ended = at_.stage == Stage::StoodBack || at_.stage == Stage::Landed;
  if (ended) enter(Stage::Waiting, "ordered to fly by a new GOAL");
}

void Bridge::flight_is_under_way() {
  if (flies() || ordered_by_goal_ || !std::exchange(ordered_, false)) return;
  out_.log("a GOAL is older than this bridge: the flight is under way or over, so it does not arm");
}

void Bridge::land(const std::string& why) {
  ordered_ = ordered_by_goal_ = false;
  if (at_.stage == Stage::StoodBack && autopilot_.armed()) out_.log(why + ": not landed, since " + at_.why);
  if (!flies() || at_.stage == Stage::Landing) return;
  hold_here(now_);
  followed_ = false;
  enter(Stage::Landing, why);
  if (!autopilot_.armed() && arm_asked_ && now_ - *arm_asked_ < kCommandFlight) {
    out_.log("the autopilot may still execute the arming request: disarming it");
  }
}

std::optional<UavState> Bridge::in_world(std::optional<UavState> local) const {
  if (local) local->motion.p += origin_;
  return local;
}

void Bridge::watch_clock() {
  const std::string fault = clock_fault(autopilot_);
  if (!fault.empty() && !clock_is_off_) out_.log(fault);
  clock_is_off_ = !fault.empty();
}

VehicleStatus Bridge::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.armed = autopilot_.armed();
  status.why_not = why_not_following(now);
  status.following = status.armed && status.why_not.empty();
  if (!status.following && status.why_not.empty()) status.why_not = "not armed";
  status.why_not.resize(std::min(status.why_not.size(), kMaxReason));
  status.why_not += follow_record_.for_how_long(now);
  status.landed = autopilot_.landed().value_or(false);
  status.mode = autopilot_.mode();
  status.battery = autopilot_.battery();
  status.estimator = autopilot_.estimator();
  status.position_sigma = config_.sigma_share * autopilot_.sigma();
  status.resets = autopilot_.resets();
  if (config_.odometry != OdometrySource::None) {
    status.position_sigma = report_.drift_sigma();
    status.resets = frame_.jumps();
    if (!odometry_fault(now).empty()) status.estimator = EstimatorHealth::Lost;
  }
  return status;
}

void Bridge::step(UTime now) {
  command_.settle(now - kSetpointSilence);
  command_.forget_before(now - kHeld);
  step_stage(now);
  now_ = now;
  if (next_heartbeat_.take(now, kHeartbeatPeriod)) send_heartbeats();
  const Duration timesync_period = autopilot_.clock().ready() ? kTimesyncPeriod : kFirstTimesyncPeriod;
  if (autopilot_.address() && next_timesync_.take(now, timesync_period)) {
    out_.send(Timesync{.ts1 = now.us * 1000});
    if (config_.odometry == OdometrySource::Companion) companion_out_.send(Timesync{.ts1 = now.us * 1000});
  }
  if (at_.stage == Stage::Landed || ends_) parameters_.set_back(autopilot_, now, out_);
  if (at_.stage == Stage::Following && !parameters_.all_asked()) request_parameters(now);
  request_streams(now);
  modes_.request_heartbeat(autopilot_, flies(), now, out_);
  stream(now);
  const std::string line = follow_record_.step(autopilot_.armed(), why_not_following(now), now);
  if (!line.empty()) out_.log(line);
}

}  // namespace tern::mavlink
