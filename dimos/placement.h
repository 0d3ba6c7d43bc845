// DimOS's world in W.
#pragma once

#include <string>

#include "core/base/time.h"
#include "core/base/types.h"
#include "ros_bridge/transforms.h"
#include "ros_messages/marker_types.h"
#include "ros_messages/types.h"

namespace tern::dimos {

/// The name of W among DimOS's frames. No module publishes it.
inline constexpr char kTernFrame[] = "tern";

/// The pose of DimOS's world D in W: x_W = R(yaw)·x_D + origin.
class Placement {
 public:
  /// @param frame  DimOS's name of its world
  /// @param yaw  of D's x axis in W, rad
  Placement(std::string frame, const Vec3& origin, double yaw);

  /// The pose as a static transform, for readers of frames.
  [[nodiscard]] ros::TransformStamped transform() const;
  /// Turns messages in W into the same in D.
  [[nodiscard]] ros::Path in_dimos(ros::Path path) const;
  [[nodiscard]] ros::MarkerArray in_dimos(ros::MarkerArray markers) const;

 private:
  [[nodiscard]] ros::Pose in_dimos(const ros::Pose& pose) const;

  std::string frame_;
  ros::RigidTransform pose_WD_;
};

}  // namespace tern::dimos
