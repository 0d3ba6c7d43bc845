// The stages of a flight and their transitions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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
/// An autopilot reports its battery within this time.
constexpr Duration kBatteryPatience{2'000'000};
/// Deceleration when the vehicle is taken over in flight, m/s².
constexpr double kStop = 4.0;

}  // namespace

void Bridge::enter(Stage stage, const std::string& why) {
  if (stage == at_.stage && why == at_.why) return;
  out_.log(fmt::format("{}{}{}", to_string(stage), why.empty() ? "" : ": ", why));
  if (stage == at_.stage) {
    at_.why = why;
    return;
  }
  if (at_.stage == Stage::Following) {
    if (const std::string line = tracking_.measured_line(); !line.empty()) out_.log(line);
  }
  at_ = Present{};
  at_.stage = stage;
  at_.why = why;
  at_.since = now_;
  out_.expect_command(now_);
  if (stage == Stage::Waiting) own_.reset();
  if (stage == Stage::Following) has_followed_ = true;
  if (stage == Stage::Engaging) modes_.keep_found_once(autopilot_);
}

void Bridge::stand_back(const std::string& why) {
  ordered_ = ordered_by_goal_ = followed_ = false;
  modes_.forget_found();
  streaming_since_.reset();
  enter(Stage::StoodBack, why);
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

void Bridge::step_ready(UTime now) {
  if (!not_ready(now).empty()) return enter(Stage::Waiting, not_ready(now));
  if (!followed_) hold_here(now);
  const bool armed = autopilot_.armed(), ours = armed && autopilot_.follows();
  const bool by_command = autopilot_.stack().takes_off_by_command();
  if (!in_air() && !armed) truth_.stand(autopilot_.state(), autopilot_.truth());
  if (ours && in_air()) return enter(is_taking_off() ? Stage::Engaging : Stage::Following);
  const bool has_other_pilot =
      ordered_by_goal_ ? modes_.has_found() && modes_.is_taken_over(autopilot_) : config_.start == Start::Arm;
  if (armed && !ours && has_other_pilot) return stand_back(other_pilot_reason(autopilot_, config_.without_remote));
  const std::string grounded = in_air() ? "" : ground_fault(state()->motion.p, autopilot_, uav_, config_);
  if (!grounded.empty()) return enter(Stage::Ready, grounded);
  if (ours) return enter(by_command ? Stage::Engaging : Stage::Climbing);
  if (!ordered_) return enter(Stage::Ready, "waits for the pilot (arm, take off, switch) or for a new GOAL");
  if (by_command) return enter(Stage::Engaging);
  if (streaming_since_ && now - *streaming_since_ >= kStreamFirst) enter(Stage::Engaging);
}

/// NAV_TAKEOFF has the height above home: the place of arming, unless home was set.
void Bridge::request_take_off(UTime now) {
  const auto reported = autopilot_.home_height();
  if (!reported && now - autopilot_.arming_changed() < kHomePatience) return;
  const double home = reported.value_or(autopilot_.state()->motion.p.z());
  const CommandParams above_home{0, 0, 0, 0, 0, 0, static_cast<float>(uav_.start.z() - home)};
  if (out_.command(now, kNavTakeoff, above_home, kTakeOffPeriod)) at_.take_off_asked = true;
}

void Bridge::engage_next(UTime now) {
  const FlightStack& stack = autopilot_.stack();
  if (!autopilot_.follows()) {
    return modes_.command(autopilot_, now, stack.following_mode(), kDoSetMode, stack.following_command(), out_);
  }
  if (!autopilot_.armed()) {
    if (vision_.fault().empty() && out_.command(now, kArmDisarm, {1})) arm_asked_ = now;
    return;
  }
  if (in_air() && !at_.take_off_asked && !is_taking_off()) return enter(Stage::Following);
  if (!stack.takes_off_by_command()) return enter(Stage::Climbing);
  if (!in_air()) return request_take_off(now);
  const MotionSample here = state()->motion;
  if (std::abs(uav_.start.z() - here.p.z()) < kThere && here.v.norm() < kThereSpeed) enter(Stage::Climbing);
}

void Bridge::step_engaging(UTime now) {
  if (now - at_.since > kEngagePatience) {
    return stand_back(at_.refusal.empty() ? "the autopilot does not answer" : at_.refusal);
  }
  if (!autopilot_.linked(now)) return;
  if (modes_.is_taken_over(autopilot_)) return stand_back(other_pilot_reason(autopilot_, config_.without_remote));
  if (!in_air() && !autopilot_.armed()) truth_.stand(autopilot_.state(), autopilot_.truth());
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
  if (!rests) return at_.rests_since.reset();
  if (!at_.rests_since) at_.rests_since = now;
  if (now - *at_.rests_since >= kRested) enter(Stage::Following);
}

/// The estimate moves, so the place to stay at is taken anew each time.
void Bridge::stay_while_apart(UTime now) {
  followed_ = false;
  hold_here(now);
  if (vision_.apart_for() >= kApartPatience) land(vision_.fault());
}

/// SETPOINT is flown on until it rests, so the vehicle ends where its last plan ends.
bool Bridge::has_lost_odometry(UTime now) {
  constexpr double kRests = 0.01;  // m/s
  const bool rests = at_.stage == Stage::Following && command_.sample(now).v.norm() < kRests;
  if (odometry_fault(now).empty() || !rests) {
    at_.lost_since.reset();
  } else if (!at_.lost_since) {
    at_.lost_since = now;
  }
  return at_.lost_since && now - *at_.lost_since >= kOdometryPatience;
}

void Bridge::step_flying(UTime now) {
  if (!autopilot_.linked(now)) return;
  if (!autopilot_.armed()) return stand_back("the autopilot has disarmed");
  if (!autopilot_.follows()) return stand_back(mode_change_reason(autopilot_, config_.without_remote));
  if (autopilot_.battery().value_or(1.0) < config_.battery_land) {
    return land(fmt::format("battery {:.0f} %", 100.0 * *autopilot_.battery()));
  }
  watch_clock();
  if (has_lost_odometry(now)) return land(odometry_fault(now));
  if (!vision_.fault().empty()) return stay_while_apart(now);
  at_.stage == Stage::Climbing ? climb(now) : follow(now);
}

void Bridge::follow(UTime now) {
  const bool near = setpoint_received_ && setpoint_near(now) && estimate_fault(now).empty() &&
                    tilt_fault(autopilot_, tilt_ramp_, now).empty();
  const auto here = state();
  if (near || followed_) {
    const auto vehicle = here ? std::optional(here->motion.p) : std::nullopt;
    const std::string far = bound_fault(command_.sample(now).p, vehicle, uav_, kLastBound);
    if (!far.empty()) return land(far);
  }
  if (!near && followed_) hold_here(now);
  followed_ = near;
  if (!autopilot_.battery() && now - at_.since > kBatteryPatience && !std::exchange(at_.battery_missed, true)) {
    out_.log("the autopilot reports no battery charge: a low one will not end the flight");
  }
  if (!near || !here) return tracking_.pause();
  const auto gains = autopilot_.stack().level_gains(autopilot_.parameters());
  tracking_.add(*here, command_.sample(here->at), gains);
  const std::string lag = lag_was_logged_ ? "" : tracking_.lag_line(config_.drag_per_s);
  if (lag.empty()) return;
  lag_was_logged_ = true;
  out_.log(lag);
}

void Bridge::step_landing(UTime now) {
  if (!autopilot_.linked(now)) return;
  const bool arming = arm_asked_ && now - *arm_asked_ < kCommandFlight;
  if (!autopilot_.armed()) {
    if (!arming) return enter(Stage::Landed, at_.why);
    out_.command(now, kArmDisarm, {0}, kDisarmPeriod);
    return;
  }
  if (!vision_.fault().empty()) hold_here(now);
  if (autopilot_.landing()) {
    at_.landing_seen = true;
    streaming_since_.reset();
    return;
  }
  if (at_.landing_seen || !autopilot_.follows())
    return stand_back(mode_change_reason(autopilot_, config_.without_remote));
  if (arming && !in_air()) {
    out_.command(now, kArmDisarm, {0}, kDisarmPeriod);
    return;
  }
  const FlightStack& stack = autopilot_.stack();
  modes_.command(autopilot_, now, stack.landing_mode(), kNavLand, stack.landing_command(), out_);
}

void Bridge::step_stage(UTime now) {
  switch (at_.stage) {
    case Stage::Waiting: return step_waiting(now);
    case Stage::Ready: return step_ready(now);
    case Stage::Engaging: return step_engaging(now);
    case Stage::Climbing:
    case Stage::Following: return step_flying(now);
    case Stage::StoodBack:
      if (config_.start == Start::Pilot && autopilot_.follows() && autopilot_.armed() && !modes_.has_pilots_choice()) {
        enter(Stage::Waiting, "the pilot has switched to the following mode");
      }
      return;
    case Stage::Landing: return step_landing(now);
    case Stage::Landed: return;
  }
}

}  // namespace tern::mavlink
