// ROS's messages as Tern's values: checked, and turned into W. Pure.
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/map_file.h"
#include "core/world/observation.h"
#include "core/world/scan.h"
#include "ros_bridge/transforms.h"
#include "ros_messages/types.h"

namespace tern::ros {

/// The frame W, as ROS calls it (REP 105).
inline constexpr char kWorldFrame[] = "map";
/// Sensors of ROS on OBSTACLE_OBSERVATIONS and POINT_CLOUD.
inline constexpr std::int32_t kRosSensor = 2'000;
/// Odometry older than this says nothing about the vehicle now, as for all receivers of UAV_STATE.
inline constexpr Duration kOldestOdometry{300'000};
/// Detections and clouds may be this old.
inline constexpr Duration kOldestMeasurement{1'000'000};
/// A sensor of the vehicle is at most this far from it, m.
inline constexpr double kOnVehicle = 3.0;
/// Larger clouds are thinned to every second, third … point.
inline constexpr std::int64_t kMaxCloudPoints = std::int64_t{4} * kMaxCloudPointsPerMessage;

/// Why a message is not used.
struct Refusal {
  std::string why;
  bool may_come = false;  ///< a transform is missing, and may arrive
};
template <class T>
using Taken = tl::expected<T, Refusal>;

/// The inputs of a reading, apart from the message.
struct IntakeContext {
  const TransformBuffer& transforms;
  UTime now;
  std::optional<Vec3> vehicle = {};  ///< its newest position, W
  double vehicle_speed = 0.0;        ///< m/s
  double detection_sigma_m = 0.1;    ///< standard deviation of positions without covariance, m
  double detection_range_m = 0.0;    ///< of the detector, m; 0: unlimited
  double cloud_range_m = 0.0;        ///< of the lidar, m; 0: unlimited
  std::string cloud_sensor = {};     ///< the frame whose origin is the lidar; "": see the reading of a cloud
  std::string world_frame = kWorldFrame;
  std::string placed_world = {};  ///< another world, whose pose in W is fixed; "": none

  [[nodiscard]] bool is_world(const std::string& frame) const { return frame == world_frame || frame == placed_world; }
};

/// The state of the vehicle by one odometry, in W.
struct OdometryReading {
  UTime at;
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();  ///< m, m/s
  double yaw = 0.0;                                       ///< rad, of the body's x axis
  Vec3 position_sigma = Vec3::Zero();                     ///< m per axis; 0: unknown
};

/// The pose is in header.frame_id, and the velocity in the axes of the child, which is the vehicle's body. A covariance
/// with a negative or infinite number counts as unknown.
Taken<OdometryReading> read(const ros::Odometry& odometry, const IntakeContext& context);
/// The same of a pose alone: velocity 0 (pose_velocity.h derives it), sigma unknown.
Taken<OdometryReading> read_odometry(const ros::PoseStamped& odometry, const IntakeContext& context);

/// Each oriented box becomes the box along W's axes that contains it. The variance is that of the first result, or
/// detection_sigma_m². An `id` of digits below 10⁹ is the track id; another text becomes a number of its own.
/// @return a Refusal for the whole message if one detection is not a box, or two have one id
Taken<ObservationSet> read(const ros::Detection3DArray& array, const IntakeContext& context);

/// The position of a goal in W. A stamp of 0 means now; its age does not matter.
Taken<Vec3> read(const ros::PoseStamped& goal, const IntakeContext& context);

/// The scans of a cloud with float32 fields x, y, z, and with `class` (uint8) if it has one. Rays begin at the origin
/// of cloud_sensor. If that is empty: at the vehicle for a cloud in a world, and at the origin of the cloud's frame
/// otherwise.
/// @return a Refusal also if, without cloud_sensor, the vehicle's position is unknown. The same if that origin is
/// farther
///   from it than kOnVehicle and the way since the cloud's stamp. Such a frame is `odom`, or a lidar's fixed world, and
///   space that no ray has passed would become free
Taken<std::vector<CloudScan>> read(const ros::PointCloud2& cloud, const IntakeContext& context);

/// The parts of an OctoMap as a file, whose time is context.now: an OctoMap stays valid however old it is. Its frame
/// may lie elsewhere than W, but its axes must be W's to 1e-3 rad. tern-mapper reads the octree.
Taken<std::vector<MapFile>> read(const ros::Octomap& octomap, const IntakeContext& context);

/// Returns the pose of a frame in W. @param at  nullopt: the newest
Taken<RigidTransform> pose_of(const std::string& frame, std::optional<UTime> at, const IntakeContext& context);

}  // namespace tern::ros
