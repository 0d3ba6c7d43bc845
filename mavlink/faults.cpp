#include "mavlink/faults.h"

#include <fmt/format.h>

#include <cmath>

#include "core/world/flyable.h"

namespace tern::mavlink {
namespace {

/// Largest deviation of the autopilot clock's rate. A slower simulation moves in slow motion and cannot follow.
constexpr double kClockOff = 0.05;
/// Smallest climb, m: with less the vehicle may not leave the ground.
constexpr double kMinClimb = 0.3;
/// `not following` says for how long, from this time on.
constexpr Duration kLong{1'000'000};

std::string seconds(Duration d) { return fmt::format("{:.1f} s", d.seconds()); }

}  // namespace

std::string link_fault(const Autopilot& autopilot, UTime now) {
  if (!autopilot.address()) return "no HEARTBEAT of an autopilot was received";
  if (autopilot.linked(now)) return {};
  return "no message from the autopilot for " + seconds(now - autopilot.last_received());
}

std::string clock_fault(const Autopilot& autopilot) {
  const double rate = autopilot.clock().rate();
  if (std::abs(rate - 1.0) <= kClockOff) return {};
  return fmt::format(
      "the autopilot's clock runs at {:.2f} of this clock's rate: its simulation does not run in real time", rate);
}

std::string tilt_fault(const Autopilot& autopilot, const TiltRamp& ramp, UTime now) {
  const Duration left = autopilot.stack().tilt_limited(autopilot.parameters(), ramp, now);
  if (left == Duration{}) return {};
  return fmt::format("its tilt is still limited after take-off, for {} (MPC_TKO_RAMP_T, MPC_TILTMAX_LND)",
                     seconds(left));
}

std::string ground_fault(const Vec3& here, const Autopilot& autopilot, const UavSpec& uav, const BridgeConfig& config) {
  const Vec3 climb = uav.start - here;
  const double aside = climb.head<2>().norm(), battery = autopilot.battery().value_or(1.0);
  if (aside > config.reach_m) {
    return fmt::format("the vehicle stands {:.1f} m from below uav.start, more than {:g} m", aside, config.reach_m);
  }
  if (climb.z() < kMinClimb) {
    return fmt::format(
        "the vehicle stands at a height of {:.1f} m in its own frame, and uav.start is at {:.1f} m, not {:g} m above "
        "it: start the autopilot anew where it stands, or set uav.start higher",
        here.z(), uav.start.z(), kMinClimb);
  }
  return battery < config.battery_start ? fmt::format("battery {:.0f} %", 100.0 * battery) : "";
}

std::string bound_fault(const Vec3& setpoint, const std::optional<Vec3>& vehicle, const UavSpec& uav, double beyond_m) {
  const Box inner = centre_box(uav.flight_box, uav.body);
  const Box bound(inner.min() - Vec3::Constant(beyond_m), inner.max() + Vec3::Constant(beyond_m));
  const auto text = [&](const char* what, const Vec3& p) {
    return fmt::format("{} is at ({:.1f}, {:.1f}, {:.1f}) m, more than {:g} m outside uav.flight_box", what, p.x(),
                       p.y(), p.z(), beyond_m);
  };
  if (!bound.contains(setpoint)) return text("SETPOINT", setpoint);
  return vehicle && !bound.contains(*vehicle) ? text("the vehicle", *vehicle) : "";
}

std::string failsafe_reason(const Autopilot& autopilot, bool without_remote) {
  const bool has_no_pilot = without_remote && autopilot.armed() && autopilot.comes_down();
  if (!autopilot.in_failsafe() && !has_no_pilot) return {};
  return fmt::format("autopilot failsafe: it is in {}", autopilot.mode());
}

std::string mode_change_reason(const Autopilot& autopilot, bool without_remote) {
  if (std::string failsafe = failsafe_reason(autopilot, without_remote); !failsafe.empty()) return failsafe;
  return fmt::format("the autopilot has changed to {}: {}", autopilot.mode(),
                     autopilot.comes_down() ? "a pilot's command, or its failsafe" : "another pilot flies");
}

std::string other_pilot_reason(const Autopilot& autopilot, bool without_remote) {
  if (std::string failsafe = failsafe_reason(autopilot, without_remote); !failsafe.empty()) return failsafe;
  return fmt::format("the vehicle is {}in {}: another pilot flies", autopilot.armed() ? "armed " : "",
                     autopilot.mode());
}

std::string FollowRecord::step(bool armed, const std::string& why, UTime now) {
  if (!armed) {
    has_followed_ = false;
    not_since_.reset();
    return {};
  }
  if (why.empty()) {
    has_followed_ = true;
    const auto since = std::exchange(not_since_, std::nullopt);
    return since ? fmt::format("follows again, after {}", seconds(now - *since)) : "";
  }
  if (!has_followed_ || not_since_) return {};
  not_since_ = now;
  return "does not follow: " + why;
}

std::string FollowRecord::for_how_long(UTime now) const {
  if (!not_since_ || now - *not_since_ < kLong) return {};
  return fmt::format(" (for {:.0f} s)", (now - *not_since_).seconds());
}

}  // namespace tern::mavlink
