// The table "Tern value ↔ ROS message". docs/reference/ros_messages.md prints it.
#pragma once

#include <string>

#include "core/world/goal.h"
#include "core/world/observation.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "ros_messages/types.h"

namespace tern::ros {

/// Frames as ROS names them (REP 105).
struct Frames {
  std::string world = "map";       ///< W
  std::string body = "base_link";  ///< B: at the vehicle's position, turned by its yaw
};

/// The sampling of a trajectory: as often as this, but at most kSamplesPerInterval times in an interval.
inline constexpr double kSampleStep = 0.1;  // s
inline constexpr int kSamplesPerInterval = 8;

Time to_ros(UTime time);
Span to_ros(Duration span);
Quaternion quaternion_of_yaw(double yaw);

/// Position and yaw in W, velocity in B: ROS's twist is in the child's frame.
/// @param position_sigma  standard deviation of the position per axis, m; 0: unknown, as in VEHICLE_STATUS
Odometry odometry_of(const UavState& state, const Vec3& position_sigma, const Frames& frames);
/// The pose of B in W.
TFMessage transform_of(const UavState& state, const Frames& frames);
/// An axis-aligned box per detection; `id` is the track id, or empty. `results` is empty: a detection has no class.
Detection3DArray detections_of(const ObservationSet& frame, const Frames& frames);
PoseStamped pose_of(const Goal& goal, const Frames& frames);
/// Points along the trajectory, from its start to its end, each with its time. The yaw is that of the velocity.
Path path_of(const TimedSpline& trajectory, const Frames& frames);
/// The same points with velocity and acceleration in W, as trajectory followers read them.
MultiDOFJointTrajectory trajectory_of(const TimedSpline& trajectory, const Frames& frames);
/// A setpoint, as a trajectory of one point.
MultiDOFJointTrajectory setpoint_of(const UavState& setpoint, const Frames& frames);
/// The centres of all voxels that are neither free nor unknown: x, y, z (float32), label and class (uint8).
PointCloud2 cloud_of(const VoxelMap& map, UTime at, const Frames& frames);

}  // namespace tern::ros
