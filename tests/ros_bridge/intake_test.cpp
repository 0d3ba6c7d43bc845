// ROS's messages as Tern's values: there and back, by brute force, and by hostile bytes.
#include "ros_bridge/intake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <limits>

#include "messages/codec.h"
#include "ros_messages/cdr.h"
#include "tests/ros_bridge/made_up.h"
#include "tests/support/effort.h"

namespace tern::ros {
namespace {

using ::testing::HasSubstr;

constexpr UTime kNow{1'700'000'000'000'000};

class Intake : public ::testing::Test {
 protected:
  template <class T>
  std::string why_not(const T& message) {
    const auto taken = read(message, context);
    return taken ? "it is used" : taken.error().why;
  }

  std::mt19937_64 rng{3};
  TransformBuffer transforms;
  IntakeContext context{transforms, kNow, Vec3(1.0, 2.0, 3.0)};
};

/// An odometry in map, as Tern itself writes it.
ros::Odometry some_odometry() {
  UavState state;
  state.at = kNow;
  state.motion.p = Vec3(1.0, 2.0, 3.0);
  state.motion.v = Vec3(4.0, -1.0, 0.5);
  state.yaw = 2.5;
  return ros::odometry_of(state, Vec3(0.1, 0.2, 0.3), {});
}

TEST_F(Intake, ReadsBackWhatTernWrites) {
  const auto reading = read(some_odometry(), context);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->at, kNow);
  EXPECT_LT((reading->position - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((reading->velocity - Vec3(4.0, -1.0, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(reading->yaw, 2.5, 1e-12);
  EXPECT_LT((reading->position_sigma - Vec3(0.1, 0.2, 0.3)).norm(), 1e-12);

  ObservationSet frame;
  frame.at = kNow;
  frame.detections = {{Vec3(5.0, 6.0, 7.0), Vec3(0.5, 1.0, 1.5), Vec3::Zero(), 12},
                      {Vec3(8.0, 6.0, 7.0), Vec3::Ones()}};
  const auto taken = read(ros::detections_of(frame, {}), context);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->sensor_position, Vec3(1.0, 2.0, 3.0)) << "the vehicle's";
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(taken->detections[k].position, frame.detections[k].position);
    EXPECT_EQ(taken->detections[k].half_extents, frame.detections[k].half_extents);
    EXPECT_EQ(taken->detections[k].track_id, frame.detections[k].track_id);
    EXPECT_LT((taken->detections[k].variance - Vec3::Constant(0.01)).norm(), 1e-12) << "detection_sigma_m²";
  }
}

TEST_F(Intake, TurnsTheVelocityByTheWholeAttitude) {
  for (int k = 0; k < 100; ++k) {
    const RigidTransform T_MO = any_pose(rng), T_OB = any_pose(rng);
    const Vec3 v_B = any_vec(rng, 10.0);
    ASSERT_TRUE(transforms.add(transform_of("map", "odom", T_MO, kNow), false, kNow));
    ros::Odometry odometry = some_odometry();
    odometry.header.frame_id = "odom";
    odometry.pose.pose = to_ros(T_OB);
    odometry.twist.twist.linear = to_ros(v_B);
    const auto reading = read(odometry, context);
    ASSERT_TRUE(reading);
    // The velocity moves a point of the body as it moves in W.
    constexpr double kStep = 1e-6;
    const Vec3 moved = T_MO(T_OB(kStep * v_B)), here = T_MO(T_OB(Vec3::Zero()));
    EXPECT_LT(((moved - here) / kStep - reading->velocity).norm(), 1e-6);
    EXPECT_LT((here - reading->position).norm(), 1e-12);
  }
}

/// A box along W's axes contains all corners of the turned one, and touches the farthest of them.
TEST_F(Intake, MakesBoxesThatContainTheTurnedOnes) {
  for (int k = 0; k < 100; ++k) {
    const RigidTransform T_WS = any_pose(rng), T_SD = any_pose(rng);
    ASSERT_TRUE(transforms.add(transform_of("map", "lidar", T_WS, kNow), false, kNow));
    ros::Detection3DArray array{{ros::to_ros(kNow), "lidar"}, {}};
    ros::Detection3D& detection = array.detections.emplace_back();
    const Vec3 size = any_vec(rng, 3.0).cwiseAbs();
    detection.bbox = {to_ros(T_SD), to_ros(size)};
    const auto frame = read(array, context);
    ASSERT_TRUE(frame);
    EXPECT_LT((frame->sensor_position - T_WS.p).norm(), 1e-12);
    const Detection& box = frame->detections.at(0);
    Vec3 farthest = Vec3::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 4) != 0 ? 0.5 : -0.5);
      farthest = farthest.cwiseMax((T_WS(T_SD(sign.cwiseProduct(size))) - box.position).cwiseAbs());
    }
    EXPECT_LT((farthest - box.half_extents).norm(), 1e-9);
  }
}

TEST_F(Intake, ReadsIdsOfDigitsAndNumbersOthers) {
  ros::Detection3DArray array{{ros::to_ros(kNow), "map"}, std::vector<ros::Detection3D>(4)};
  array.detections[0].id = "7";
  array.detections[1].id = "person_7";
  array.detections[2].id = "1000000000";
  const auto frame = read(array, context);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->detections[0].track_id, 7);
  EXPECT_EQ(frame->detections[1].track_id, read(array, context)->detections[1].track_id);
  for (int k : {1, 2}) {
    EXPECT_GE(frame->detections[idx(k)].track_id, 0);
    EXPECT_LT(frame->detections[idx(k)].track_id, 1'000'000'000);
  }
  EXPECT_EQ(frame->detections[3].track_id, kNoTrackId);
  array.detections[3].id = "7";
  EXPECT_THAT(why_not(array), HasSubstr("detections[3]: a second one with the id \"7\""));
}

TEST_F(Intake, SaysWhatIsWrong) {
  ros::Odometry odometry = some_odometry();
  odometry.header.stamp = ros::to_ros(kNow - Duration{400'000});
  EXPECT_THAT(why_not(odometry), HasSubstr("its stamp is 0.400 s old; clocks must agree"));
  odometry = some_odometry();
  odometry.header.frame_id = "";
  EXPECT_THAT(why_not(odometry), HasSubstr("header.frame_id is empty"));
  odometry.header.frame_id = "odom";
  EXPECT_THAT(why_not(odometry), HasSubstr("no transform leads from odom to map"));
  EXPECT_TRUE(read(odometry, context).error().may_come);
  odometry = some_odometry();
  odometry.twist.twist.linear.z = std::numeric_limits<double>::infinity();
  EXPECT_THAT(why_not(odometry), HasSubstr("the velocity is not finite"));
  odometry = some_odometry();
  odometry.pose.covariance[7] = -1.0;
  EXPECT_EQ(read(odometry, context)->position_sigma, Vec3::Zero()) << "unknown";

  ros::Detection3DArray array{{ros::to_ros(kNow), "map"}, std::vector<ros::Detection3D>(1)};
  array.detections[0].bbox.size.y = -1.0;
  EXPECT_THAT(why_not(array), HasSubstr("detections[0]: bbox.size [0, -1, 0] is no size"));
  ros::PoseStamped goal{{{}, "map"}, {{1.0, std::nan(""), 2.0}, {}}};
  EXPECT_THAT(why_not(goal), HasSubstr("is no place"));
}

/// A cloud of float32 x, y, z and a class, with bytes between them.
ros::PointCloud2 cloud_of(const std::vector<Eigen::Vector3f>& points, std::uint32_t height = 1) {
  ros::PointCloud2 cloud;
  cloud.header = {ros::to_ros(kNow), "lidar"};
  cloud.point_fields = {{"intensity", 0, 7, 1}, {"z", 4, 7, 1}, {"x", 8, 7, 1}, {"y", 16, 7, 1}, {"class", 21, 2, 1}};
  cloud.point_step = 24;
  cloud.height = height;
  cloud.width = static_cast<std::uint32_t>(points.size()) / height;
  cloud.row_step = cloud.width * cloud.point_step + 8;
  cloud.data.resize(std::size_t{cloud.row_step} * height);
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::uint8_t* bytes = cloud.data.data() + k / cloud.width * cloud.row_step + k % cloud.width * cloud.point_step;
    std::memcpy(bytes + 8, &points[k].x(), 4);
    std::memcpy(bytes + 16, &points[k].y(), 4);
    std::memcpy(bytes + 4, &points[k].z(), 4);
    bytes[21] = static_cast<std::uint8_t>(k);
  }
  return cloud;
}

TEST_F(Intake, ReadsClouds) {
  RigidTransform T_WS = any_pose(rng);
  T_WS.p = *context.vehicle + Vec3(0.3, -0.2, 0.1);
  ASSERT_TRUE(transforms.add(transform_of("map", "lidar", T_WS, kNow), false, kNow));
  std::vector<Eigen::Vector3f> points;
  for (int k = 0; k < 12; ++k) points.push_back(any_vec(rng, 20.0).cast<float>());
  const auto scans = read(cloud_of(points, 3), context);
  ASSERT_TRUE(scans);
  ASSERT_EQ(scans->size(), 1U);
  EXPECT_EQ((*scans)[0].sensor_position, T_WS.p);
  ASSERT_EQ((*scans)[0].points.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const CloudPoint& point = (*scans)[0].points[k];
    EXPECT_LT((point.position.cast<double>() - T_WS.q * points[k].cast<double>()).norm(), 1e-5);
    EXPECT_EQ(point.class_number, k);
  }
  points[3].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(read(cloud_of(points), context)->at(0).points.size(), points.size() - 1) << "no return";
}

TEST_F(Intake, RaysOfACloudBeginAtTheSensor) {
  context.vehicle = Vec3(20.0, 0.0, 2.0);
  RigidTransform T_WS;
  T_WS.p = *context.vehicle + Vec3(0.2, 0.0, 0.1);
  ASSERT_TRUE(transforms.add(transform_of("map", "lidar", T_WS, kNow), false, kNow));
  ASSERT_TRUE(transforms.add(transform_of("map", "odom", {}, kNow), false, kNow));
  auto cloud = cloud_of({{25.0F, 0.0F, 2.0F}});
  const auto sensor_position = [&] { return read(cloud, context).value().at(0).sensor_position; };
  EXPECT_EQ(sensor_position(), T_WS.p);
  cloud.header.frame_id = "map";
  EXPECT_EQ(sensor_position(), *context.vehicle);
  cloud.header.frame_id = "odom";
  EXPECT_THAT(why_not(cloud), HasSubstr("the origin of its frame odom lies 20.1 m from the vehicle"));
  context.cloud_sensor = "lidar";
  EXPECT_EQ(sensor_position(), T_WS.p);
  EXPECT_LT((read(cloud, context)->at(0).points[0].position.cast<double>() - (Vec3(25, 0, 2) - T_WS.p)).norm(), 1e-5);
  context.cloud_sensor = "";
  T_WS.p = *context.vehicle - Vec3(5.0, 0.0, 0.0);
  ASSERT_TRUE(transforms.add(transform_of("map", "late_lidar", T_WS, kNow), true, kNow));
  cloud.header.frame_id = "late_lidar";
  cloud.header.stamp = ros::to_ros(kNow - Duration{300'000});
  EXPECT_THAT(why_not(cloud), HasSubstr("lies 5.0 m from the vehicle"));
  context.vehicle_speed = 8.0;
  EXPECT_EQ(sensor_position(), T_WS.p) << "where the vehicle was 0.3 s ago";
  cloud.header.frame_id = "odom";
  cloud.header.stamp = ros::to_ros(kNow);
  context.vehicle.reset();
  EXPECT_THAT(why_not(cloud), HasSubstr("needs the vehicle's position"));
  context.vehicle = Vec3(20.0, 0.0, 2.0);
  context.placed_world = "odom";
  EXPECT_EQ(sensor_position(), *context.vehicle);
}

TEST_F(Intake, RefusesWhatATransformCarriesBeyondAllCoordinates) {
  RigidTransform T_WF;
  T_WF.p = Vec3(9e5, 0.0, 0.0);
  ASSERT_TRUE(transforms.add(transform_of("map", "odom", T_WF, kNow), false, kNow));
  auto odometry = some_odometry();
  odometry.header.frame_id = "odom";
  odometry.pose.pose.position.x = 2e5;
  EXPECT_THAT(why_not(odometry), HasSubstr("beyond all coordinates"));
  ros::PoseStamped goal;
  goal.header.frame_id = "odom";
  goal.pose.position.x = 2e5;
  EXPECT_THAT(why_not(goal), HasSubstr("beyond all coordinates"));
  ObservationSet frame;
  frame.at = kNow;
  frame.detections = {{Vec3(2e5, 6.0, 7.0), Vec3(0.5, 1.0, 1.5), Vec3::Zero(), 12}};
  auto detections = ros::detections_of(frame, {});
  detections.header.frame_id = "odom";
  for (auto& detection : detections.detections) detection.header.frame_id = "odom";
  EXPECT_THAT(why_not(detections), HasSubstr("beyond all coordinates"));
}

TEST_F(Intake, SplitsAndThinsLargeClouds) {
  context.vehicle = Vec3::Zero();
  ASSERT_TRUE(transforms.add(transform_of("map", "lidar", {}, kNow), false, kNow));
  for (const std::size_t n : {4'000U, 4'001U, 16'000U, 16'001U, 100'000U}) {
    const auto scans = read(cloud_of(std::vector<Eigen::Vector3f>(n, Eigen::Vector3f::Ones())), context);
    ASSERT_TRUE(scans);
    std::size_t points = 0;
    for (const CloudScan& scan : *scans) {
      points += scan.points.size();
      EXPECT_EQ(scan.at, kNow) << "one scan";
      CloudScan named = scan;
      named.header.name = {1, 1};
      EXPECT_LE(encode(named).size(), std::size_t{kMaxMessageBytes});
    }
    const std::size_t every = (n + 15'999) / 16'000;
    EXPECT_EQ(points, (n + every - 1) / every);
  }
}

TEST_F(Intake, RefusesCloudsThatDoNotFit) {
  context.vehicle = Vec3::Zero();
  ASSERT_TRUE(transforms.add(transform_of("map", "lidar", {}, kNow), false, kNow));
  const auto good = cloud_of(std::vector<Eigen::Vector3f>(10, Eigen::Vector3f::Ones()));
  auto cloud = good;
  cloud.width = 11;
  EXPECT_THAT(why_not(cloud), HasSubstr("1 × 11 points of 24 bytes do not fit"));
  cloud = good;
  cloud.height = 0x80000000U;
  EXPECT_THAT(why_not(cloud), HasSubstr("do not fit"));
  cloud = good;
  cloud.point_fields[1].offset = 0xFFFFFFFFU;
  EXPECT_THAT(why_not(cloud), HasSubstr("the field z lies outside its point"));
  cloud = good;
  cloud.point_fields[2].datatype = 8;
  EXPECT_THAT(why_not(cloud), HasSubstr("no float32 field x"));
  cloud = good;
  cloud.is_bigendian = true;
  EXPECT_THAT(why_not(cloud), HasSubstr("big-endian"));
}

ros::Octomap some_octomap(std::size_t bytes) {
  ros::Octomap octomap{{ros::to_ros(kNow), "map"}, true, "OcTree", 0.05, {}};
  for (std::size_t k = 0; k < bytes; ++k) octomap.data.push_back(static_cast<std::int8_t>(k * 37));
  return octomap;
}

TEST_F(Intake, AnOctoMapIsAFileInParts) {
  const ros::RigidTransform moved{Eigen::Quaterniond::Identity(), Vec3(10.0, -2.0, 0.5)};
  ASSERT_TRUE(transforms.add(transform_of("map", "odom", moved, kNow), true, kNow));
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{2}, std::size_t{59'000}, std::size_t{200'000}}) {
    for (const bool is_binary : {true, false}) {
      ros::Octomap octomap = some_octomap(bytes);
      octomap.header.frame_id = "odom";
      octomap.header.stamp = {1, 0};  // years ago
      octomap.binary = is_binary;
      const auto parts = read(octomap, context);
      ASSERT_TRUE(parts) << parts.error().why;
      std::string file;
      for (std::size_t k = 0; k < parts->size(); ++k) {
        MapFile part = (*parts)[k];
        part.header.name = {1, 1};
        EXPECT_LE(encode(part).size(), std::size_t{kMaxMessageBytes});
        EXPECT_EQ(part.part, static_cast<int>(k));
        EXPECT_EQ(part.parts, std::ssize(*parts));
        EXPECT_EQ(part.at, kNow);
        EXPECT_EQ(part.origin, Vec3(10.0, -2.0, 0.5));
        file.append(part.bytes.begin(), part.bytes.end());
      }
      const std::string head = std::string(is_binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file") +
                               "\nid OcTree\nsize " + (bytes == 0 ? "0" : "1") + "\nres 0.05\ndata\n";
      EXPECT_EQ(file, head + std::string(octomap.data.begin(), octomap.data.end()));
    }
  }
}

TEST_F(Intake, RefusesOctoMapsThatTernCannotUse) {
  ros::Octomap octomap = some_octomap(4);
  octomap.id = "OcTreeStamped";
  EXPECT_THAT(why_not(octomap), HasSubstr("of the kind \"OcTreeStamped\""));
  octomap = some_octomap(4);
  octomap.resolution = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(why_not(octomap), HasSubstr("resolution of nan"));
  octomap = some_octomap(59'000'000);
  EXPECT_THAT(why_not(octomap), HasSubstr("limit 59000000"));
  const ros::RigidTransform turned{Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vec3::UnitZ())), Vec3::Zero()};
  ASSERT_TRUE(transforms.add(transform_of("map", "odom", turned, kNow), true, kNow));
  octomap = some_octomap(4);
  octomap.header.frame_id = "odom";
  EXPECT_THAT(why_not(octomap), HasSubstr("is turned by 0.100 rad"));
}

/// A value that is accepted after mutations of a message's bytes obeys the contract of its channel.
TEST_F(Intake, HostileBytesGiveLegalMessagesOrNone) {
  ASSERT_TRUE(transforms.add(transform_of("map", "lidar", any_pose(rng), kNow), false, kNow));
  ros::Detection3DArray array{{ros::to_ros(kNow), "lidar"}, std::vector<ros::Detection3D>(3)};
  array.detections[0].results.resize(1);
  const std::vector<std::string> valid = {
      ros::encode_cdr(some_odometry()), ros::encode_cdr(array),
      ros::encode_cdr(cloud_of(std::vector<Eigen::Vector3f>(20, Eigen::Vector3f::Ones()), 2)),
      ros::encode_cdr(ros::PoseStamped{{ros::to_ros(kNow), "map"}, {}}),
      ros::encode_cdr(ros::TFMessage{{transform_of("map", "a", any_pose(rng), kNow)}})};
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  int used = 0;
  const int mutations = support::at_effort(500'000);
  for (int k = 0; k < mutations; ++k) {
    const std::size_t which = below(valid.size());
    std::vector<std::uint8_t> bytes(valid[which].begin(), valid[which].end());
    if (below(4) == 0) bytes.resize(below(bytes.size() + 20));
    for (std::size_t n = below(4) + 1; n > 0 && !bytes.empty(); --n)
      bytes[below(bytes.size())] = static_cast<std::uint8_t>(rng());
    const auto publish = [&](auto message) {
      message.header.name = {1, 1};
      message.header.utime = kNow;
      EXPECT_NO_THROW((void)encode(message));
      ++used;
    };
    const auto try_as = [&]<class T>(T) -> std::optional<T> { return ros::decode_cdr<T>(bytes); };
    if (which == 0) {
      const auto message = try_as(ros::Odometry());
      const auto reading = message ? read(*message, context) : Taken<OdometryReading>();
      if (!message || !reading) continue;
      UavState state;
      state.at = reading->at;
      state.motion.p = reading->position;
      state.motion.v = reading->velocity;
      state.yaw = reading->yaw;
      publish(state);
      VehicleStatus status;
      status.why_not = "x";
      status.position_sigma = reading->position_sigma;
      publish(status);
    } else if (which == 1) {
      const auto message = try_as(ros::Detection3DArray());
      if (const auto frame = message ? read(*message, context) : Taken<ObservationSet>(); message && frame)
        publish(*frame);
    } else if (which == 2) {
      const auto message = try_as(ros::PointCloud2());
      if (const auto scans = message ? read(*message, context) : Taken<std::vector<CloudScan>>(); message && scans) {
        for (const CloudScan& scan : *scans) publish(scan);
      }
    } else if (which == 3) {
      const auto message = try_as(ros::PoseStamped());
      if (const auto position = message ? read(*message, context) : Taken<Vec3>(); message && position) {
        Goal goal;
        goal.id = 1;
        goal.position = *position;
        publish(goal);
      }
      if (message) (void)read_odometry(*message, context);
    } else if (const auto message = try_as(ros::TFMessage())) {
      for (const auto& transform : message->transforms) (void)transforms.add(transform, rng() % 2 == 0, kNow);
    }
  }
  EXPECT_GT(used, mutations / 20) << "or else this shows nothing";
}

TEST_F(Intake, HostileOctoMapsGiveLegalPartsOrNone) {
  const std::string valid = ros::encode_cdr(some_octomap(40));
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  int used = 0;
  const int mutations = support::at_effort(100'000);
  for (int k = 0; k < mutations; ++k) {
    std::vector<std::uint8_t> bytes(valid.begin(), valid.end());
    if (below(4) == 0) bytes.resize(below(bytes.size() + 20));
    for (std::size_t n = below(4) + 1; n > 0 && !bytes.empty(); --n)
      bytes[below(bytes.size())] = static_cast<std::uint8_t>(rng());
    const auto message = ros::decode_cdr<ros::Octomap>(bytes);
    const auto parts = message ? read(*message, context) : Taken<std::vector<MapFile>>();
    for (std::size_t i = 0; parts && i < parts->size(); ++i) {
      MapFile part = (*parts)[i];
      part.header = {{1, 1}, kNow};
      EXPECT_NO_THROW((void)encode(part));
      ++used;
    }
  }
  EXPECT_GT(used, mutations / 20) << "or else this shows nothing";
}

}  // namespace
}  // namespace tern::ros
