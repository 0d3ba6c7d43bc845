#include "ros_bridge/intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <set>

#include "core/base/digest.h"
#include "core/wire/message_limits.h"
#include "ros_bridge/stamps.h"

namespace tern::ros {
namespace {

constexpr std::int64_t kTrackIds = 1'000'000'000;

tl::unexpected<Refusal> refuse(std::string why) { return tl::unexpected(Refusal{std::move(why), false}); }

bool is_finite(const ros::Vector3& v, double limit) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= limit && !std::isnan(v.x + v.y + v.z);
}

bool is_place(const Vec3& p) { return p.cwiseAbs().maxCoeff() <= kMaxCoordinate; }

Vec3 vec(const ros::Vector3& v) { return {v.x, v.y, v.z}; }

/// Returns the variance of a position per axis of W; nullopt if the covariance is unknown.
std::optional<Vec3> variance_in(const Eigen::Matrix3d& R, const std::array<double, 36>& covariance) {
  Eigen::Matrix3d in_frame;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      in_frame(row, column) = covariance[static_cast<std::size_t>(6 * row + column)];
    }
  }
  const Vec3 variance = (R * in_frame * R.transpose()).diagonal();
  if (!in_frame.allFinite() || in_frame.diagonal().minCoeff() < 0.0 || variance.minCoeff() < 0.0) return std::nullopt;
  if (variance.maxCoeff() > kMaxCoordinate) return std::nullopt;
  return variance;
}

std::int64_t track_id_of(const std::string& id) {
  if (id.empty()) return kNoTrackId;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  const bool is_number = error == std::errc{} && end == id.data() + id.size() && number >= 0 && number < kTrackIds;
  return is_number ? number : static_cast<std::int64_t>(digest(id) % static_cast<std::uint64_t>(kTrackIds));
}

Taken<Detection> read_detection(const ros::Detection3D& in, const RigidTransform& T_WF, const IntakeContext& context) {
  const auto T_FD = read_pose(in.bbox.center);
  if (!T_FD) return refuse(T_FD.error().message);
  const Vec3 size = vec(in.bbox.size);
  if (!is_finite(in.bbox.size, kMaxCoordinate) || size.minCoeff() < 0.0) {
    return refuse(fmt::format("bbox.size [{}, {}, {}] is no size", size.x(), size.y(), size.z()));
  }
  const RigidTransform T_WD = T_WF.after(*T_FD);
  if (!is_place(T_WD.p)) return refuse("its centre lies beyond all coordinates in W");
  Detection out;
  out.position = T_WD.p;
  out.half_extents = T_WD.q.toRotationMatrix().cwiseAbs() * size / 2;
  const auto variance =
      in.results.empty() ? std::nullopt : variance_in(T_WF.q.toRotationMatrix(), in.results[0].pose.covariance);
  const double sigma = context.detection_sigma_m;
  out.variance = variance && variance->maxCoeff() > 0.0 ? *variance : Vec3::Constant(sigma * sigma);
  out.track_id = track_id_of(in.id);
  return out;
}

/// The place of x, y, z and class in a point.
struct PointLayout {
  std::array<std::size_t, 3> axes{};
  std::optional<std::size_t> class_number;
};

Taken<PointLayout> layout_of(const ros::PointCloud2& cloud) {
  constexpr std::uint8_t kUint8 = 2, kFloat32 = 7;
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  PointLayout layout;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find_if(cloud.point_fields.begin(), cloud.point_fields.end(),
                                    [&](const ros::PointField& field) { return field.name == kAxes[axis]; });
    if (found == cloud.point_fields.end() || found->datatype != kFloat32) {
      return refuse(fmt::format("the cloud has no float32 field {}", kAxes[axis]));
    }
    if (std::uint64_t{found->offset} + sizeof(float) > cloud.point_step) {
      return refuse(fmt::format("the field {} lies outside its point", kAxes[axis]));
    }
    layout.axes[axis] = found->offset;
  }
  for (const ros::PointField& field : cloud.point_fields) {
    if (field.name == "class" && field.datatype == kUint8 && field.offset < cloud.point_step) {
      layout.class_number = field.offset;
    }
  }
  if (cloud.is_bigendian) return refuse("its numbers are big-endian; send little-endian ones");
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  const std::uint64_t before = cloud.height == 0 ? 0 : std::uint64_t{cloud.row_step} * (cloud.height - 1);
  if (row > cloud.row_step || before + row > cloud.data.size()) {
    return refuse(fmt::format("{} × {} points of {} bytes do not fit into {} bytes", cloud.height, cloud.width,
                              cloud.point_step, cloud.data.size()));
  }
  return layout;
}

/// The body at a time, and the frame that it was reported in.
struct PoseInWorld {
  UTime at;
  RigidTransform T_WF, T_WB;
};

Taken<PoseInWorld> read_pose_in_world(const ros::PoseStamped& pose, const IntakeContext& context, Duration oldest) {
  const UTime at = time_of(pose.header.stamp);
  if (auto timely = check_stamp(at, context.now, oldest); !timely) return refuse(timely.error().message);
  const auto T_WF = pose_of(pose.header.frame_id, at, context);
  if (!T_WF) return tl::unexpected(T_WF.error());
  const auto T_FB = read_pose(pose.pose);
  if (!T_FB) return refuse(T_FB.error().message);
  const RigidTransform T_WB = T_WF->after(*T_FB);
  if (!is_place(T_WB.p)) return refuse("its position lies beyond all coordinates in W");
  return PoseInWorld{at, *T_WF, T_WB};
}

OdometryReading reading_of(const PoseInWorld& pose) {
  const Vec3 forward = pose.T_WB.q * Vec3::UnitX();
  return {pose.at, pose.T_WB.p, Vec3::Zero(), std::atan2(forward.y(), forward.x()), Vec3::Zero()};
}

/// Where the rays of a cloud begin, W.
Taken<Vec3> sensor_of(const ros::PointCloud2& cloud, UTime at, const IntakeContext& context) {
  if (!context.cloud_sensor.empty()) return pose_of(context.cloud_sensor, at, context).map(&RigidTransform::p);
  const std::string& frame = cloud.header.frame_id;
  if (!context.vehicle) {
    return refuse(fmt::format("a cloud in {} needs the vehicle's position, which is not known yet", frame));
  }
  if (context.is_world(frame)) return *context.vehicle;
  const auto T_WF = pose_of(frame, at, context);
  if (!T_WF) return tl::unexpected(T_WF.error());
  const double away = (T_WF->p - *context.vehicle).norm();
  const double moved = context.vehicle_speed * std::max((context.now - at).seconds(), 0.0);
  if (away <= kOnVehicle + moved) return T_WF->p;
  return refuse(
      fmt::format("the origin of its frame {} lies {:.1f} m from the vehicle: name the lidar's frame by cloud-sensor",
                  frame, away));
}

float float_at(const std::uint8_t* bytes) {
  float x = 0.0F;
  std::memcpy(&x, bytes, sizeof x);
  return x;
}

}  // namespace

Taken<RigidTransform> pose_of(const std::string& frame, std::optional<UTime> at, const IntakeContext& context) {
  if (frame.empty()) return refuse("header.frame_id is empty; it must name a frame");
  auto pose = context.transforms.find(context.world_frame, frame, at);
  if (!pose) return tl::unexpected(Refusal{pose.error().message + " (/tf, /tf_static)", true});
  return *pose;
}

Taken<OdometryReading> read(const ros::Odometry& odometry, const IntakeContext& context) {
  const auto pose = read_pose_in_world({odometry.header, odometry.pose.pose}, context, kOldestOdometry);
  if (!pose) return tl::unexpected(pose.error());
  if (!is_finite(odometry.twist.twist.linear, kMaxSpeed)) return refuse("the velocity is not finite");
  OdometryReading reading = reading_of(*pose);
  reading.velocity = pose->T_WB.q * vec(odometry.twist.twist.linear);
  const auto variance = variance_in(pose->T_WF.q.toRotationMatrix(), odometry.pose.covariance);
  if (variance) reading.position_sigma = variance->cwiseSqrt();
  return reading;
}

Taken<OdometryReading> read_odometry(const ros::PoseStamped& odometry, const IntakeContext& context) {
  const auto pose = read_pose_in_world(odometry, context, kOldestOdometry);
  if (!pose) return tl::unexpected(pose.error());
  return reading_of(*pose);
}

Taken<ObservationSet> read(const ros::Detection3DArray& array, const IntakeContext& context) {
  ObservationSet frame;
  frame.at = time_of(array.header.stamp);
  frame.sensor_id = kRosSensor;
  frame.range_m = context.detection_range_m;
  if (auto timely = check_stamp(frame.at, context.now, kOldestMeasurement); !timely) {
    return refuse(timely.error().message);
  }
  if (array.detections.size() > std::size_t{kMaxDetections}) {
    return refuse(fmt::format("{} detections are more than {}", array.detections.size(), kMaxDetections));
  }
  const auto T_WS = pose_of(array.header.frame_id, frame.at, context);
  if (!T_WS) return tl::unexpected(T_WS.error());
  if (!is_place(T_WS->p)) return refuse("its sensor lies beyond all coordinates in W");
  const bool in_world = context.is_world(array.header.frame_id);
  frame.sensor_position = in_world ? context.vehicle.value_or(Vec3::Zero()) : T_WS->p;
  std::set<std::int64_t> ids;
  for (std::size_t k = 0; k < array.detections.size(); ++k) {
    const ros::Detection3D& in = array.detections[k];
    Taken<RigidTransform> T_WF = *T_WS;
    if (!in.header.frame_id.empty() && in.header.frame_id != array.header.frame_id) {
      T_WF = pose_of(in.header.frame_id, frame.at, context);
    }
    if (!T_WF) return tl::unexpected(T_WF.error());
    const auto detection = read_detection(in, *T_WF, context);
    if (!detection) return refuse(fmt::format("detections[{}]: {}", k, detection.error().why));
    if (detection->track_id != kNoTrackId && !ids.insert(detection->track_id).second) {
      return refuse(fmt::format("detections[{}]: a second one with the id \"{:.40}\"", k, in.id));
    }
    frame.detections.push_back(*detection);
  }
  return frame;
}

Taken<Vec3> read(const ros::PoseStamped& goal, const IntakeContext& context) {
  const UTime at = time_of(goal.header.stamp);
  const auto T_WF = pose_of(goal.header.frame_id, at == UTime{} ? std::nullopt : std::optional(at), context);
  if (!T_WF) return tl::unexpected(T_WF.error());
  const ros::Point& p = goal.pose.position;
  if (!is_finite({p.x, p.y, p.z}, kMaxCoordinate)) {
    return refuse(fmt::format("the position [{}, {}, {}] is no place", p.x, p.y, p.z));
  }
  const Vec3 goal_in_world = (*T_WF)(Vec3(p.x, p.y, p.z));
  if (!is_place(goal_in_world)) return refuse("the position lies beyond all coordinates in W");
  return goal_in_world;
}

Taken<std::vector<CloudScan>> read(const ros::PointCloud2& cloud, const IntakeContext& context) {
  const UTime at = time_of(cloud.header.stamp);
  if (auto timely = check_stamp(at, context.now, kOldestMeasurement); !timely) return refuse(timely.error().message);
  const auto layout = layout_of(cloud);
  if (!layout) return tl::unexpected(layout.error());
  const auto T_WS = pose_of(cloud.header.frame_id, at, context);
  if (!T_WS) return tl::unexpected(T_WS.error());
  const auto sensor = sensor_of(cloud, at, context);
  if (!sensor) return tl::unexpected(sensor.error());
  if (!is_place(*sensor)) return refuse("its sensor lies beyond all coordinates in W");
  CloudScan part;
  part.at = at;
  part.sensor_id = kRosSensor;
  part.range_m = context.cloud_range_m;
  part.sensor_position = *sensor;
  part.has_classes = layout->class_number.has_value();
  std::vector<CloudScan> parts{part};
  const std::int64_t all = std::int64_t{cloud.width} * cloud.height;
  const std::int64_t every = (all + kMaxCloudPoints - 1) / kMaxCloudPoints;
  for (std::int64_t k = 0; k < all; k += every) {
    const std::uint8_t* bytes =
        cloud.data.data() + k / cloud.width * cloud.row_step + k % cloud.width * cloud.point_step;
    const Vec3 p(float_at(bytes + layout->axes[0]), float_at(bytes + layout->axes[1]),
                 float_at(bytes + layout->axes[2]));
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kMaxCoordinate) continue;  // no return
    if (parts.back().points.size() == std::size_t{kMaxCloudPointsPerMessage}) parts.push_back(part);
    const Vec3 from_sensor = (*T_WS)(p)-part.sensor_position;
    parts.back().points.push_back(
        {from_sensor.cast<float>(), layout->class_number ? bytes[*layout->class_number] : std::uint8_t{0}});
  }
  return parts;
}

}  // namespace tern::ros
