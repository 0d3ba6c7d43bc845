#include "ros_bridge/odometry_vehicle.h"

#include <fmt/format.h>

#include "core/world/estimate_jump.h"
#include "ros_bridge/slope.h"

namespace tern::ros {
Result<UavState> OdometryVehicle::receive(const OdometryReading& reading) {
  if (!readings_.empty()) {
    const OdometryReading& last = readings_.back();
    const Duration later = reading.at - last.at;
    if (later <= Duration{})
      return fail(fmt::format("its stamp is {:.3f} s before that of the last one", -later.seconds()));
    if (estimate_jumps(last.position, last.velocity, reading.position, later)) {
      ++resets_;
      readings_.clear();
    }
  }
  readings_.push_back(reading);
  while (reading.at - readings_.front().at > kSlope) readings_.pop_front();
  UavState state;
  state.at = reading.at;
  state.motion.p = reading.position;
  state.motion.v = reading.velocity;
  state.motion.a = slope_of(readings_, &OdometryReading::velocity);
  state.yaw = reading.yaw;
  return state;
}

void OdometryVehicle::receive_following(bool following, UTime now) {
  told_ = following ? std::optional(now) : std::nullopt;
}

VehicleStatus OdometryVehicle::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.mode = mode_;
  status.resets = resets_;
  if (readings_.empty()) {
    status.why_not = "no odometry has come";
    status.estimator = EstimatorHealth::Lost;
    return status;
  }
  status.position_sigma = readings_.back().position_sigma;
  const Duration age = now - readings_.back().at;
  if (age > kOldestOdometry) {
    status.why_not = fmt::format("the newest odometry is {:.1f} s old", age.seconds());
    status.estimator = EstimatorHealth::Lost;
  } else if (asks_ && (!told_ || now - *told_ > kOldestWord)) {
    status.why_not = "/following does not say true";
  }
  status.armed = status.following = status.why_not.empty();
  return status;
}

std::optional<Vec3> OdometryVehicle::position() const {
  return readings_.empty() ? std::nullopt : std::optional(readings_.back().position);
}

}  // namespace tern::ros
