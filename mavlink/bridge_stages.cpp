// The stages of a flight and their transitions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mavlink/bridge.h"

namespace tern::mavlink {
namespace {

/// Setpoints are sent for this long before OFFBOARD is requested.
constexpr Duration kStreamFirst{1'000'000};
/// On a slow machine, a simulated estimator may take this long before arming is possible.
constexpr Duration kEngagePatience{120'000'000};
/// The climb ends when the vehicle has been within this distance of uav.start, below this speed, for kRested.
constexpr double kThere = 0.3, kThereSpeed = 0.4;  // m, m/s
constexpr Duration kRested{1'000'000};
/// Smallest climb, m: with less the vehicle may not leave the ground.
constexpr double kMinClimb = 0.3;
/// The climb's setpoint waits while it is this far above the vehicle, m: rotors spin up, and PX4 takes off slowly.
constexpr double kClimbAhead = 0.5;
/// Period of disarm requests. It is shorter than the spin-up, so an armed vehicle is still on the ground.
constexpr Duration kDisarmPeriod{250'000};
/// Period of take-off requests. An ArduPilot on the ground restarts its take-off with each one.
constexpr Duration kTakeOffPeriod{3'000'000};
/// An ArduPilot reports home within this time: GLOBAL_POSITION_INT is requested at 5 Hz.
constexpr Duration kHomePatience{1'000'000};
/// An estimate that has been apart from external vision for this long is not waited for any longer.
constexpr Duration kApartPatience{1'000'000};
constexpr float kPx4Offboard = 6, kArduPilotGuided = 4;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void Bridge::step_waiting(UTime now) {
  if (!ends_) request_parameters(now);
  const std::string why = not_ready(now);
  if (why.empty()) {
    hold_here(now);
    return enter(Stage::Ready);
  }
  // A silence that only grows longer is not logged again.
  if (autopilot_.linked(now) || !autopilot_.address()) enter(Stage::Waiting, why);
}

/// The reason why it cannot take off from its place, or "".
std::string Bridge::ground_fault() const {
  const Vec3 climb = uav_.start - state()->motion.p;
  const double aside = climb.head<2>().norm(), battery = autopilot_.battery().value_or(1.0);
  if (aside > config_.reach_m) {
    return fmt::format("the vehicle stands {:.1f} m from below uav.start, more than {:g} m", aside, config_.reach_m);
  }
  if (climb.z() < kMinClimb) {
    return fmt::format(
        "the vehicle stands at a height of {:.1f} m in its own frame, and uav.start is at {:.1f} m, not {:g} m above "
        "it: start the autopilot anew where it stands, or set uav.start higher",
        state()->motion.p.z(), uav_.start.z(), kMinClimb);
  }
  return battery < config_.battery_start ? fmt::format("battery {:.0f} %", 100.0 * battery) : "";
}

void Bridge::step_ready(UTime now) {
  if (!not_ready(now).empty()) return enter(Stage::Waiting, not_ready(now));
  if (!followed_) hold_here(now);
  if (!in_air()) anchor_truth();
  const bool armed = autopilot_.armed(), ours = armed && autopilot_.follows();
  if (ours && in_air()) return enter(is_taking_off() ? Stage::Engaging : Stage::Following);
  const bool has_other_pilot = ordered_by_goal_ ? found_ && is_taken_over() : config_.start == Start::Arm;
  if (armed && !ours && has_other_pilot) return stand_back(other_pilot_reason());
  if (const std::string fault = in_air() ? "" : ground_fault(); !fault.empty()) return enter(Stage::Ready, fault);
  if (ours) return enter(takes_off_by_command() ? Stage::Engaging : Stage::Climbing);
  if (!ordered_) return enter(Stage::Ready, "waits for the pilot (arm, take off, switch) or for a new GOAL");
  if (takes_off_by_command()) return enter(Stage::Engaging);
  if (streaming_since_ && now - *streaming_since_ >= kStreamFirst) enter(Stage::Engaging);
}

/// NAV_TAKEOFF has the height above home: the place of arming, unless home was set.
void Bridge::request_take_off(UTime now) {
  const auto reported = autopilot_.home_height();
  if (now < next_command_ || (!reported && now - autopilot_.arming_changed() < kHomePatience)) return;
  const double home = reported.value_or(autopilot_.state()->motion.p.z());
  command(now, kNavTakeoff, {0, 0, 0, 0, 0, 0, static_cast<float>(uav_.start.z() - home)});
  next_command_ = now + kTakeOffPeriod;
  take_off_asked_ = true;
}

void Bridge::engage_next(UTime now) {
  const float mode = takes_off_by_command() ? kArduPilotGuided : kPx4Offboard;
  if (!autopilot_.follows()) return command_mode(now, autopilot_.following_mode(), kDoSetMode, {1, mode});
  if (!autopilot_.armed()) {
    if (!vision_.fault().empty()) return;
    if (now >= next_command_) arm_asked_ = now;
    return command(now, kArmDisarm, {1});
  }
  if (in_air() && !take_off_asked_ && !is_taking_off()) return enter(Stage::Following);
  if (!takes_off_by_command()) return enter(Stage::Climbing);
  if (!in_air()) return request_take_off(now);
  const MotionSample here = state()->motion;
  if (std::abs(uav_.start.z() - here.p.z()) < kThere && here.v.norm() < kThereSpeed) enter(Stage::Climbing);
}

/// The autopilot's own reason for a mode that is not the bridge's, or "".
std::string Bridge::failsafe_reason() const {
  const bool has_no_pilot = config_.without_remote && autopilot_.armed() && autopilot_.comes_down();
  if (!autopilot_.in_failsafe() && !has_no_pilot) return {};
  return fmt::format("autopilot failsafe: it is in {}", autopilot_.mode());
}

std::string Bridge::mode_change_reason() const {
  if (std::string failsafe = failsafe_reason(); !failsafe.empty()) return failsafe;
  return fmt::format("the autopilot has changed to {}: {}", autopilot_.mode(),
                     autopilot_.comes_down() ? "a pilot's command, or its failsafe" : "another pilot flies");
}

std::string Bridge::other_pilot_reason() const {
  if (std::string failsafe = failsafe_reason(); !failsafe.empty()) return failsafe;
  return fmt::format("the vehicle is {}in {}: another pilot flies", autopilot_.armed() ? "armed " : "",
                     autopilot_.mode());
}

/// Whether another sender has changed mode or arming since the bridge began to engage. HEARTBEAT reports both together,
/// and the bridge arms in the following mode only. So any other mode, or arming in another mode, is someone else's.
bool Bridge::is_taken_over() {
  if (!autopilot_.follows()) return !found_ || found_->mode != autopilot_.mode() || found_->armed < autopilot_.armed();
  found_.reset();
  return false;
}

void Bridge::step_engaging(UTime now) {
  if (now - stage_since_ > kEngagePatience) {
    return stand_back(refusal_.empty() ? "the autopilot does not answer" : refusal_);
  }
  if (!autopilot_.linked(now)) return;
  if (is_taken_over()) return stand_back(other_pilot_reason());
  if (!in_air()) anchor_truth();
  hold_here(now);
  engage_next(now);
}

void Bridge::climb(UTime now) {
  MotionSample& own = own_->motion;
  const Vec3 way = uav_.start - own.p;
  const auto here = state();
  const bool waits = here && own.p.z() - here->motion.p.z() > kClimbAhead;
  const double left = way.norm(), next = waits ? 0.0 : config_.climb_speed * std::min((now - now_).seconds(), 0.1);
  own.v = left > 1e-9 ? Vec3(way * (config_.climb_speed / left)) : Vec3::Zero();
  if (left <= next) {
    own.p = uav_.start;
    own.v = Vec3::Zero();
  } else {
    own.p += way * (next / left);
  }
  const bool rests = here && own.p == uav_.start && (here->motion.p - uav_.start).norm() < kThere &&
                     here->motion.v.norm() < kThereSpeed && in_air();
  if (!rests) return rests_since_.reset();
  if (!rests_since_) rests_since_ = now;
  if (now - *rests_since_ >= kRested) enter(Stage::Following);
}

/// The estimate moves, so the place to stay at is taken anew each time.
void Bridge::stay_while_apart(UTime now) {
  followed_ = false;
  hold_here(now);
  if (vision_.apart_for() >= kApartPatience) land(vision_.fault());
}

void Bridge::step_flying(UTime now) {
  if (!autopilot_.linked(now)) return;
  if (!autopilot_.armed()) return stand_back("the autopilot has disarmed");
  if (!autopilot_.follows()) return stand_back(mode_change_reason());
  if (autopilot_.battery().value_or(1.0) < config_.battery_land) {
    return land(fmt::format("battery {:.0f} %", 100.0 * *autopilot_.battery()));
  }
  watch_clock();
  if (!vision_.fault().empty()) return stay_while_apart(now);
  if (stage_ == Stage::Climbing) return climb(now);
  const bool near = setpoint_received_ && setpoint_near(now) && estimate_fault(now).empty() && tilt_fault(now).empty();
  if (near || followed_) {
    if (const std::string far = beyond_last_bound(now); !far.empty()) return land(far);
  }
  if (!near && followed_) hold_here(now);
  followed_ = near;
  if (near) {
    watch_lag();
  } else {
    identification_.pause();
  }
}

void Bridge::request_disarm(UTime now) {
  if (now < next_command_) return;
  command(now, kArmDisarm, {0});
  next_command_ = now + kDisarmPeriod;
}

void Bridge::step_landing(UTime now) {
  if (!autopilot_.linked(now)) return;
  const bool arming = arm_asked_ && now - *arm_asked_ < kCommandFlight;
  if (!autopilot_.armed()) {
    if (!arming) return enter(Stage::Landed, why_);
    return request_disarm(now);
  }
  if (!vision_.fault().empty()) hold_here(now);
  if (autopilot_.landing()) {
    landing_seen_ = true;
    streaming_since_.reset();
    return;
  }
  if (landing_seen_ || !autopilot_.follows()) return stand_back(mode_change_reason());
  if (arming && !in_air()) return request_disarm(now);
  // An ArduPilot converts the unknown position to integers; it does not use it.
  const float here = autopilot_.firmware() == Firmware::ArduPilot ? 0.0F : kUnknown;
  command_mode(now, autopilot_.landing_mode(), kNavLand, {0, 0, 0, here, here, here, 0});
}

void Bridge::step_stage(UTime now) {
  switch (stage_) {
    case Stage::Waiting: return step_waiting(now);
    case Stage::Ready: return step_ready(now);
    case Stage::Engaging: return step_engaging(now);
    case Stage::Climbing:
    case Stage::Following: return step_flying(now);
    case Stage::StoodBack:
      if (config_.start == Start::Pilot && autopilot_.follows() && autopilot_.armed() && !pilots_mode_)
        enter(Stage::Waiting, "the pilot has switched to the following mode");
      return;
    case Stage::Landing: return step_landing(now);
    case Stage::Landed: return;
  }
}

}  // namespace tern::mavlink
