#include "dimos/velocity_command.h"

#include <cmath>

namespace tern::dimos {

std::optional<ros::Twist> velocity_command(const UavState& setpoint, const UavState& vehicle,
                                           const FollowingGains& gains) {
  const Vec3 p = vehicle.motion.p + (setpoint.at - vehicle.at).seconds() * vehicle.motion.v;
  const Vec3 error = setpoint.motion.p - p;
  if (!(error.norm() <= gains.far_m)) return std::nullopt;
  const Eigen::AngleAxisd R_BW(-vehicle.yaw, Vec3::UnitZ());
  const Vec3 v_B = R_BW * Vec3(setpoint.motion.v + gains.lead_s * setpoint.motion.a + gains.position_per_s * error);
  ros::Twist twist;
  twist.linear = {v_B.x(), gains.lateral == Lateral::Left ? v_B.y() : -v_B.y(), v_B.z()};
  twist.angular.z = gains.yaw_per_s * std::remainder(setpoint.yaw - vehicle.yaw, 2.0 * M_PI);
  return twist;
}

}  // namespace tern::dimos
