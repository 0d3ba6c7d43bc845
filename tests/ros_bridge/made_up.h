// ROS messages for tests.
#pragma once

#include <random>
#include <string>

#include "ros_bridge/transforms.h"
#include "ros_messages/conversions.h"

namespace tern::ros {

inline double any_number(std::mt19937_64& rng, double within) {
  return std::uniform_real_distribution<double>(-within, within)(rng);
}
inline Vec3 any_vec(std::mt19937_64& rng, double within) {
  const double x = any_number(rng, within), y = any_number(rng, within);
  return {x, y, any_number(rng, within)};
}
inline RigidTransform any_pose(std::mt19937_64& rng) {
  const Vec3 axis = any_vec(rng, 1.0), p = any_vec(rng, 50.0);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(any_number(rng, 3.0), axis.normalized())), p};
}

inline ros::Quaternion to_ros(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline ros::Pose to_ros(const RigidTransform& pose) { return {{pose.p.x(), pose.p.y(), pose.p.z()}, to_ros(pose.q)}; }
inline ros::Vector3 to_ros(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

inline ros::TransformStamped transform_of(const std::string& parent, const std::string& child,
                                          const RigidTransform& pose, UTime at) {
  return {{ros::to_ros(at), parent}, child, {to_ros(pose.p), to_ros(pose.q)}};
}

}  // namespace tern::ros
