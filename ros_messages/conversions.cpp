#include "ros_messages/conversions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace tern::ros {
namespace {

constexpr std::int64_t kUsPerSecond = 1'000'000;
constexpr double kTurningSpeed = 0.1;  // m/s; a slower vehicle keeps its yaw

Head head(UTime at, const std::string& frame) { return {to_ros(at), frame}; }
Point point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vector3 vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::int64_t floor_seconds(std::int64_t us) {
  return us / kUsPerSecond - static_cast<std::int64_t>(us % kUsPerSecond < 0);
}

template <class T>
T seconds_and_nanoseconds(std::int64_t us) {
  const std::int64_t seconds = floor_seconds(us);
  return {static_cast<std::int32_t>(seconds), static_cast<std::uint32_t>((us - seconds * kUsPerSecond) * 1000)};
}

Vec3 rotated_about_z(const Vec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

/// Sets the diagonal entries of a covariance that belong to x, y, z.
void set_variance(std::array<double, 36>& covariance, const Vec3& variance) {
  for (std::size_t axis = 0; axis < 3; ++axis) covariance[7 * axis] = variance[static_cast<Eigen::Index>(axis)];
}

struct TimedSample {
  Duration after;
  MotionSample motion;
  double yaw = 0.0;
};

std::vector<TimedSample> samples_of(const TimedSpline& trajectory) {
  const ClampedSpline spline = trajectory.spline();
  const int per_interval =
      std::clamp(static_cast<int>(std::lround(spline.interval_s() / kSampleStep)), 1, kSamplesPerInterval);
  std::vector<TimedSample> samples;
  double yaw = 0.0;
  for (int k = 0; k <= per_interval * spline.intervals(); ++k) {
    const Duration after{trajectory.interval.us * k / per_interval};
    const MotionSample motion = spline.sample(after.seconds());
    if (motion.v.head<2>().norm() > kTurningSpeed) yaw = std::atan2(motion.v.y(), motion.v.x());
    samples.push_back({after, motion, yaw});
  }
  return samples;
}

MultiDOFJointTrajectoryPoint trajectory_point(const TimedSample& sample) {
  return {{{vector(sample.motion.p), quaternion_of_yaw(sample.yaw)}},
          {{vector(sample.motion.v), {}}},
          {{vector(sample.motion.a), {}}},
          to_ros(sample.after)};
}

void append_float(std::vector<std::uint8_t>& bytes, double x) {
  const auto value = static_cast<float>(x);
  std::array<std::uint8_t, sizeof value> raw{};
  std::memcpy(raw.data(), &value, sizeof value);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

}  // namespace

Time to_ros(UTime time) { return seconds_and_nanoseconds<Time>(time.us); }
Span to_ros(Duration span) { return seconds_and_nanoseconds<Span>(span.us); }

Quaternion quaternion_of_yaw(double yaw) { return {0.0, 0.0, std::sin(yaw / 2), std::cos(yaw / 2)}; }

Odometry odometry_of(const UavState& state, const Vec3& position_sigma, const Frames& frames) {
  Odometry odometry{head(state.at, frames.world), frames.body, {}, {}};
  odometry.pose.pose = {point(state.motion.p), quaternion_of_yaw(state.yaw)};
  odometry.twist.twist.linear = vector(rotated_about_z(state.motion.v, -state.yaw));
  set_variance(odometry.pose.covariance, position_sigma.cwiseAbs2());
  return odometry;
}

TFMessage transform_of(const UavState& state, const Frames& frames) {
  return {{{head(state.at, frames.world), frames.body, {vector(state.motion.p), quaternion_of_yaw(state.yaw)}}}};
}

Detection3DArray detections_of(const ObservationSet& frame, const Frames& frames) {
  Detection3DArray array{head(frame.at, frames.world), {}};
  for (const Detection& detection : frame.detections) {
    Detection3D& out = array.detections.emplace_back();
    out.header = array.header;
    out.bbox = {{point(detection.position), {}}, vector(2.0 * detection.half_extents)};
    out.id = detection.track_id == kNoTrackId ? "" : std::to_string(detection.track_id);
  }
  return array;
}

PoseStamped pose_of(const Goal& goal, const Frames& frames) {
  return {head(goal.header.utime, frames.world), {point(goal.position), {}}};
}

Path path_of(const TimedSpline& trajectory, const Frames& frames) {
  Path path{head(trajectory.start, frames.world), {}};
  for (const TimedSample& sample : samples_of(trajectory)) {
    path.poses.push_back(
        {head(trajectory.start + sample.after, frames.world), {point(sample.motion.p), quaternion_of_yaw(sample.yaw)}});
  }
  return path;
}

MultiDOFJointTrajectory trajectory_of(const TimedSpline& trajectory, const Frames& frames) {
  MultiDOFJointTrajectory out{head(trajectory.start, frames.world), {frames.body}, {}};
  for (const TimedSample& sample : samples_of(trajectory)) out.points.push_back(trajectory_point(sample));
  return out;
}

MultiDOFJointTrajectory setpoint_of(const UavState& setpoint, const Frames& frames) {
  return {head(setpoint.at, frames.world), {frames.body}, {trajectory_point({{}, setpoint.motion, setpoint.yaw})}};
}

PointCloud2 cloud_of(const VoxelMap& map, UTime at, const Frames& frames) {
  constexpr std::uint8_t kUint8 = 2, kFloat32 = 7;  // sensor_msgs/PointField
  PointCloud2 cloud;
  cloud.header = head(at, frames.world);
  cloud.point_fields = {{"x", 0, kFloat32, 1},
                        {"y", 4, kFloat32, 1},
                        {"z", 8, kFloat32, 1},
                        {"label", 12, kUint8, 1},
                        {"class", 13, kUint8, 1}};
  cloud.point_step = 14;
  for (std::size_t k = 0; k < map.labels.size(); ++k) {
    if (map.labels[k] < VoxelLabel::Occupied) continue;
    const Vec3 centre = map.grid.centre(map.grid.cell(static_cast<std::int64_t>(k)));
    for (int axis = 0; axis < 3; ++axis) append_float(cloud.data, centre[axis]);
    cloud.data.push_back(static_cast<std::uint8_t>(map.labels[k]));
    cloud.data.push_back(map.classes[k]);
    ++cloud.width;
  }
  cloud.row_step = cloud.width * cloud.point_step;
  return cloud;
}

}  // namespace tern::ros
