#include "ros_bridge/pose_velocity.h"

#include "ros_bridge/slope.h"

namespace tern::ros {

std::optional<Vec3> PoseVelocity::receive(const OdometryReading& reading) {
  if (readings_.empty() || reading.at > readings_.back().at) {
    while (!readings_.empty() && reading.at - readings_.front().at > kWindow) readings_.pop_front();
    if (readings_.size() >= kFewestForSlope) {
      const Vec3 ahead = (reading.at - readings_.back().at).seconds() * slope_of(readings_, &OdometryReading::position);
      if ((readings_.back().position + ahead - reading.position).norm() > kJump) readings_.clear();
    }
    readings_.push_back(reading);
  }
  if (readings_.size() < kFewestForSlope || readings_.back().at - readings_.front().at < kLeastSpan)
    return std::nullopt;
  return slope_of(readings_, &OdometryReading::position);
}

}  // namespace tern::ros
