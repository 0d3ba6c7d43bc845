// The simulated autopilot's behaviour as an ArduPilot.
#include <algorithm>

#include "mavlink/sim/simulated_autopilot.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kAccepted = 0, kFailed = 4;
/// Custom modes of Copter.
constexpr int kGuided = 4, kLoiter = 5, kLand = 9;
/// MOT_SPOOL_TIME, DISARM_DELAY.
constexpr Duration kSpoolUp{1'000'000}, kDisarmDelay{10'000'000};
constexpr double kClimbSpeed = 1.0, kStop = 4.0;

}  // namespace

std::uint8_t SimulatedAutopilot::set_ardupilots_mode(int custom) {
  if (custom == kGuided) intend(Mode::Offboard);
  if (custom == kLoiter) intend(Mode::Position);
  if (custom == kLand) intend(Mode::Land);
  return custom == kGuided || custom == kLoiter || custom == kLand ? kAccepted : kFailed;
}

std::uint8_t SimulatedAutopilot::take_off(float above_home, UTime now) {
  const double to = home_up_ + static_cast<double>(above_home);
  if (!armed_ || mode_ != Mode::Offboard || !model_.truth().on_ground) return kFailed;
  if (to <= model_.estimate().motion.p.z()) return kFailed;
  takes_off_to_ = to;
  armed_since_ = now;
  command_ = model_.estimate();
  command_.motion.v = command_.motion.a = Vec3::Zero();
  return kAccepted;
}

/// On the ground the rotors idle until NAV_TAKEOFF. After kDisarmDelay the vehicle disarms.
bool SimulatedAutopilot::ardupilots_rotors_lift(UTime t) {
  if (!model_.truth().on_ground) return true;
  if (takes_off_to_) return t - armed_since_ >= kSpoolUp;
  if (mode_ != Mode::Land && t - armed_since_ > kDisarmDelay) disarm();
  return false;
}

void SimulatedAutopilot::fly_guided(UTime t) {
  if (takes_off_to_) {
    const bool lifts = t - armed_since_ >= kSpoolUp, up = command_.motion.p.z() >= *takes_off_to_;
    command_.motion.v = Vec3(0.0, 0.0, lifts && !up ? kClimbSpeed : 0.0);
    command_.motion.p.z() =
        std::min(command_.motion.p.z() + command_.motion.v.z() * kVehicleStep.seconds(), *takes_off_to_);
    return;
  }
  if (!guided_) return;
  if (t - *last_target_ <= Duration::from_seconds(parameters_["GUID_TIMEOUT"])) {
    command_ = target_;
    const double later = (t - *last_target_).seconds();
    command_.motion.p += later * (target_.motion.v + 0.5 * later * target_.motion.a);
    command_.motion.v += later * target_.motion.a;
    return;
  }
  guided_ = false;
  const Vec3 v = command_.motion.v;
  command_.motion.p += v * (v.norm() / (2.0 * kStop));
  command_.motion.v = command_.motion.a = Vec3::Zero();
}

}  // namespace tern::mavlink
