// Messages of ROS 2 (Jazzy) that Tern writes or reads: names, types and order of the fields are those of the .msg
// files. Units are SI and radians; frames are ROS's (REP 103).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tern::ros {

/// A time since the Unix epoch.
struct Time {
  static constexpr const char* kName = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static void fields(auto& m, auto& visit) {
    visit("sec", m.sec);
    visit("nanosec", m.nanosec);
  }
};
/// A span of time.
struct Span {
  static constexpr const char* kName = "builtin_interfaces/msg/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static void fields(auto& m, auto& visit) {
    visit("sec", m.sec);
    visit("nanosec", m.nanosec);
  }
};
struct Bool {
  static constexpr const char* kName = "std_msgs/msg/Bool";
  bool data = false;
  static void fields(auto& m, auto& visit) { visit("data", m.data); }
};
/// When and in which frame.
struct Head {
  static constexpr const char* kName = "std_msgs/msg/Header";
  Time stamp;
  std::string frame_id;
  static void fields(auto& m, auto& visit) {
    visit("stamp", m.stamp);
    visit("frame_id", m.frame_id);
  }
};
struct Point {
  static constexpr const char* kName = "geometry_msgs/msg/Point";
  double x = 0.0, y = 0.0, z = 0.0;
  static void fields(auto& m, auto& visit) {
    visit("x", m.x);
    visit("y", m.y);
    visit("z", m.z);
  }
};
struct Vector3 {
  static constexpr const char* kName = "geometry_msgs/msg/Vector3";
  double x = 0.0, y = 0.0, z = 0.0;
  static void fields(auto& m, auto& visit) {
    visit("x", m.x);
    visit("y", m.y);
    visit("z", m.z);
  }
};
struct Quaternion {
  static constexpr const char* kName = "geometry_msgs/msg/Quaternion";
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  static void fields(auto& m, auto& visit) {
    visit("x", m.x);
    visit("y", m.y);
    visit("z", m.z);
    visit("w", m.w);
  }
};
struct Pose {
  static constexpr const char* kName = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;
  static void fields(auto& m, auto& visit) {
    visit("position", m.position);
    visit("orientation", m.orientation);
  }
};
struct PoseStamped {
  static constexpr const char* kName = "geometry_msgs/msg/PoseStamped";
  Head header;
  Pose pose;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("pose", m.pose);
  }
};
/// The covariance of x, y, z and the rotations about them, row by row.
struct PoseWithCovariance {
  static constexpr const char* kName = "geometry_msgs/msg/PoseWithCovariance";
  Pose pose;
  std::array<double, 36> covariance{};
  static void fields(auto& m, auto& visit) {
    visit("pose", m.pose);
    visit("covariance", m.covariance);
  }
};
struct Twist {
  static constexpr const char* kName = "geometry_msgs/msg/Twist";
  Vector3 linear, angular;
  static void fields(auto& m, auto& visit) {
    visit("linear", m.linear);
    visit("angular", m.angular);
  }
};
struct TwistWithCovariance {
  static constexpr const char* kName = "geometry_msgs/msg/TwistWithCovariance";
  Twist twist;
  std::array<double, 36> covariance{};
  static void fields(auto& m, auto& visit) {
    visit("twist", m.twist);
    visit("covariance", m.covariance);
  }
};
struct Transform {
  static constexpr const char* kName = "geometry_msgs/msg/Transform";
  Vector3 translation;
  Quaternion rotation;
  static void fields(auto& m, auto& visit) {
    visit("translation", m.translation);
    visit("rotation", m.rotation);
  }
};
/// The pose of the child frame in header.frame_id.
struct TransformStamped {
  static constexpr const char* kName = "geometry_msgs/msg/TransformStamped";
  Head header;
  std::string child_frame_id;
  Transform transform;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("child_frame_id", m.child_frame_id);
    visit("transform", m.transform);
  }
};
struct TFMessage {
  static constexpr const char* kName = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
  static void fields(auto& m, auto& visit) { visit("transforms", m.transforms); }
};
struct Clock {
  static constexpr const char* kName = "rosgraph_msgs/msg/Clock";
  Time clock;
  static void fields(auto& m, auto& visit) { visit("clock", m.clock); }
};
/// The pose is in header.frame_id, the twist in child_frame_id.
struct Odometry {
  static constexpr const char* kName = "nav_msgs/msg/Odometry";
  Head header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("child_frame_id", m.child_frame_id);
    visit("pose", m.pose);
    visit("twist", m.twist);
  }
};
struct Path {
  static constexpr const char* kName = "nav_msgs/msg/Path";
  Head header;
  std::vector<PoseStamped> poses;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("poses", m.poses);
  }
};
/// Velocities and accelerations are in the trajectory's frame.
struct MultiDOFJointTrajectoryPoint {
  static constexpr const char* kName = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
  std::vector<Transform> transforms;
  std::vector<Twist> velocities;
  std::vector<Twist> accelerations;
  Span time_from_start;
  static void fields(auto& m, auto& visit) {
    visit("transforms", m.transforms);
    visit("velocities", m.velocities);
    visit("accelerations", m.accelerations);
    visit("time_from_start", m.time_from_start);
  }
};
struct MultiDOFJointTrajectory {
  static constexpr const char* kName = "trajectory_msgs/msg/MultiDOFJointTrajectory";
  Head header;
  std::vector<std::string> joint_names;
  std::vector<MultiDOFJointTrajectoryPoint> points;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("joint_names", m.joint_names);
    visit("points", m.points);
  }
};
struct ObjectHypothesis {
  static constexpr const char* kName = "vision_msgs/msg/ObjectHypothesis";
  std::string class_id;
  double score = 0.0;
  static void fields(auto& m, auto& visit) {
    visit("class_id", m.class_id);
    visit("score", m.score);
  }
};
struct ObjectHypothesisWithPose {
  static constexpr const char* kName = "vision_msgs/msg/ObjectHypothesisWithPose";
  ObjectHypothesis hypothesis;
  PoseWithCovariance pose;
  static void fields(auto& m, auto& visit) {
    visit("hypothesis", m.hypothesis);
    visit("pose", m.pose);
  }
};
/// An oriented box; `size` is its whole extent along its own axes.
struct BoundingBox3D {
  static constexpr const char* kName = "vision_msgs/msg/BoundingBox3D";
  Pose center;
  Vector3 size;
  static void fields(auto& m, auto& visit) {
    visit("center", m.center);
    visit("size", m.size);
  }
};
struct Detection3D {
  static constexpr const char* kName = "vision_msgs/msg/Detection3D";
  Head header;
  std::vector<ObjectHypothesisWithPose> results;
  BoundingBox3D bbox;
  std::string id;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("results", m.results);
    visit("bbox", m.bbox);
    visit("id", m.id);
  }
};
struct Detection3DArray {
  static constexpr const char* kName = "vision_msgs/msg/Detection3DArray";
  Head header;
  std::vector<Detection3D> detections;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("detections", m.detections);
  }
};
/// A number in each point; datatype 2 is uint8, 7 is float32.
struct PointField {
  static constexpr const char* kName = "sensor_msgs/msg/PointField";
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 7;
  std::uint32_t count = 1;
  static void fields(auto& m, auto& visit) {
    visit("name", m.name);
    visit("offset", m.offset);
    visit("datatype", m.datatype);
    visit("count", m.count);
  }
};
struct PointCloud2 {
  static constexpr const char* kName = "sensor_msgs/msg/PointCloud2";
  Head header;
  std::uint32_t height = 1, width = 0;
  std::vector<PointField> point_fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = true;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("height", m.height);
    visit("width", m.width);
    visit("fields", m.point_fields);
    visit("is_bigendian", m.is_bigendian);
    visit("point_step", m.point_step);
    visit("row_step", m.row_step);
    visit("data", m.data);
    visit("is_dense", m.is_dense);
  }
};
/// An octree as the bytes of a .bt or .ot file without their header.
struct Octomap {
  static constexpr const char* kName = "octomap_msgs/msg/Octomap";
  Head header;
  bool binary = true;  ///< of a .bt file, else of an .ot file
  std::string id = "OcTree";
  double resolution = 0.1;  ///< m
  std::vector<std::int8_t> data;
  static void fields(auto& m, auto& visit) {
    visit("header", m.header);
    visit("binary", m.binary);
    visit("id", m.id);
    visit("resolution", m.resolution);
    visit("data", m.data);
  }
};

}  // namespace tern::ros
