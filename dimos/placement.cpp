#include "dimos/placement.h"

#include <utility>

namespace tern::dimos {

Placement::Placement(std::string frame, const Vec3& origin, double yaw)
    : frame_(std::move(frame)), pose_WD_{Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vec3::UnitZ())), origin} {}

ros::TransformStamped Placement::transform() const {
  const auto& [q, p] = pose_WD_;
  return {{{}, kTernFrame}, frame_, {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}}};
}

ros::Pose Placement::in_dimos(const ros::Pose& pose) const {
  const ros::Point& p = pose.position;
  const ros::Quaternion& q = pose.orientation;
  const auto T_DX = pose_WD_.inverse().after({Eigen::Quaterniond(q.w, q.x, q.y, q.z), Vec3(p.x, p.y, p.z)});
  return {{T_DX.p.x(), T_DX.p.y(), T_DX.p.z()}, {T_DX.q.x(), T_DX.q.y(), T_DX.q.z(), T_DX.q.w()}};
}

ros::Path Placement::in_dimos(ros::Path path) const {
  path.header.frame_id = frame_;
  for (ros::PoseStamped& pose : path.poses) {
    pose.header.frame_id = frame_;
    pose.pose = in_dimos(pose.pose);
  }
  return path;
}

ros::MarkerArray Placement::in_dimos(ros::MarkerArray markers) const {
  for (ros::Marker& marker : markers.markers) {
    marker.header.frame_id = frame_;
    marker.pose = in_dimos(marker.pose);
  }
  return markers;
}

}  // namespace tern::dimos
