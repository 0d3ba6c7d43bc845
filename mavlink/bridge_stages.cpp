// From one stage of a flight to the next.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mavlink/bridge.h"

namespace tern::mavlink {
namespace {

/// A stream of setpoints has to run before OFFBOARD is asked for.
constexpr Duration kStreamFirst{1'000'000};
/// A simulation's estimator takes this long on a slow machine until it may be armed.
constexpr Duration kEngagePatience{120'000'000};
/// Arrived at the top of the climb, m and m/s.
constexpr double kThere = 0.3, kThereSpeed = 0.4;
/// With less to climb it may not leave the ground, m.
constexpr double kMinClimb = 0.3;
/// The climb's setpoint waits when it is so far above the vehicle, m: rotors spin up, and PX4 takes off gently.
constexpr double kClimbAhead = 0.5;
/// A vehicle that is armed by such a command stands for as long as its rotors need to spin up.
constexpr Duration kDisarmPeriod{250'000};
/// ArduPilot begins its take-off anew when it is asked again on the ground, where its rotors spin up.
constexpr Duration kTakeOffPeriod{3'000'000};
/// So long it may take until an ArduPilot says where home is: it is asked to say so at 5 Hz.
constexpr Duration kHomePatience{1'000'000};
constexpr float kPx4Offboard = 6, kArduPilotGuided = 4;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void Bridge::step_waiting(UTime now) {
  request_parameters(now);
  const std::string why = not_ready(now);
  if (why.empty()) return enter(Stage::Ready);
  // Seconds that pass are no news.
  if (autopilot_.linked(now) || !autopilot_.address()) enter(Stage::Waiting, why);
}

/// Why it does not take off from where it stands.
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
  if (!ordered_) return enter(Stage::Ready, "waits for the pilot to arm, take off and switch, or for a new GOAL");
  if (takes_off_by_command()) return enter(Stage::Engaging);
  if (streaming_since_ && now - *streaming_since_ >= kStreamFirst) enter(Stage::Engaging);
}

/// ArduPilot takes the height above its home. That is where it was armed, unless somebody has set it.
void Bridge::request_take_off(UTime now) {
  const auto said = autopilot_.home_height();
  if (now < next_command_ || (!said && now - autopilot_.arming_changed() < kHomePatience)) return;
  const double home = said.value_or(autopilot_.state()->motion.p.z());
  command(now, kNavTakeoff, {0, 0, 0, 0, 0, 0, static_cast<float>(uav_.start.z() - home)});
  next_command_ = now + kTakeOffPeriod;
  take_off_asked_ = true;
}

void Bridge::engage_next(UTime now) {
  const float mode = takes_off_by_command() ? kArduPilotGuided : kPx4Offboard;
  if (!autopilot_.follows()) return command_mode(now, autopilot_.following_mode(), kDoSetMode, {1, mode});
  if (!autopilot_.armed()) {
    if (now >= next_command_) arm_asked_ = now;
    return command(now, kArmDisarm, {1});
  }
  if (in_air() && !take_off_asked_ && !is_taking_off()) return enter(Stage::Following);
  if (!takes_off_by_command()) return enter(Stage::Climbing);
  if (!in_air()) return request_take_off(now);
  const MotionSample here = state()->motion;
  if (std::abs(uav_.start.z() - here.p.z()) < kThere && here.v.norm() < kThereSpeed) enter(Stage::Climbing);
}

std::string Bridge::other_pilot_reason() const {
  return fmt::format("the vehicle is {}in {}: somebody else flies", autopilot_.armed() ? "armed " : "",
                     autopilot_.mode());
}

/// Until it has the vehicle that stays as it was found. HEARTBEAT tells mode and arming at once, and the bridge arms
/// only what follows: who is in another mode, or armed, was switched or armed by somebody else.
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
  const Vec3 way = uav_.start - own_.motion.p;
  const auto here = state();
  const bool waits = here && own_.motion.p.z() - here->motion.p.z() > kClimbAhead;
  const double left = way.norm(), next = waits ? 0.0 : config_.climb_speed * std::min((now - now_).seconds(), 0.1);
  own_.motion.v = left > 1e-9 ? Vec3(way * (config_.climb_speed / left)) : Vec3::Zero();
  if (left <= next) {
    own_.motion.p = uav_.start;
    own_.motion.v = Vec3::Zero();
  } else {
    own_.motion.p += way * (next / left);
  }
  if (here && own_.motion.p == uav_.start && (here->motion.p - uav_.start).norm() < kThere &&
      here->motion.v.norm() < kThereSpeed && in_air()) {
    enter(Stage::Following);
  }
}

void Bridge::step_flying(UTime now) {
  if (!autopilot_.linked(now)) return;
  if (!autopilot_.armed()) return stand_back("the autopilot has disarmed");
  if (!autopilot_.follows()) {
    return stand_back(fmt::format("the autopilot has left for {}: somebody else flies", autopilot_.mode()));
  }
  if (autopilot_.battery().value_or(1.0) < config_.battery_land) {
    return land(fmt::format("battery {:.0f} %", 100.0 * *autopilot_.battery()));
  }
  watch_clock();
  if (stage_ == Stage::Climbing) return climb(now);
  const bool near = setpoint_received_ && setpoint_near(now) && estimate_fault(now).empty();
  if (!near && followed_) hold_here(now);
  followed_ = near;
  if (near) watch_lag();
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
    followed_ = false;
    if (!arming) return enter(Stage::Landed, why_);
    return request_disarm(now);
  }
  if (followed_) hold_here(now);
  followed_ = false;
  if (autopilot_.landing()) {
    landing_seen_ = true;
    streaming_since_.reset();
    return;
  }
  if (landing_seen_ || !autopilot_.follows()) {
    return stand_back(fmt::format("the autopilot has left for {}: somebody else flies", autopilot_.mode()));
  }
  if (arming && !in_air()) return request_disarm(now);
  // An ArduPilot makes integers of a place that is unknown; it does not look at it.
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
        enter(Stage::Waiting, "the switch");
      return;
    case Stage::Landing: return step_landing(now);
    case Stage::Landed: return;
  }
}

}  // namespace tern::mavlink
