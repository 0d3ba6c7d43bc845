// tern-dimos as a process, with DimOS's messages by LCM's own generator on the other side. Runs inside
// tests/support/hermetic.sh, which gives it a network of its own. The test plays the rest of Tern.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "tests/dimos/dimos_peer.h"
#include "tests/support/bridge_process.h"
#include "tests/support/effort.h"
#include "tests/support/straight_plan.h"

namespace tern::dimos {
namespace {

using ::testing::HasSubstr;
using namespace channels;

class DimosProcesses : public BridgeProcess {
 protected:
  void start(std::vector<std::string> more) {
    more.insert(more.begin(), {TERN_DIMOS, "--dimos_url", kDimosUrl});
    start_bridge_and_wait(more);
  }
  void poll_peer() override { dimos.poll(); }
  bool says(const std::string& words) {
    return std::any_of(beats.begin(), beats.end(),
                       [&](const Heartbeat& beat) { return beat.waiting_for.find(words) != std::string::npos; });
  }

  DimosPeer dimos;
};

TEST_F(DimosProcesses, SendPathsAndMarkersInTheWorldOfDimos) {
  auto& paths = dimos.keep<nav_msgs::Path>(kPathChannel);
  auto& drawn = dimos.keep<visualization_msgs::MarkerArray>(kMarkersChannel);
  start({"--path", kPathChannel, "--markers_plan", kMarkersChannel, "--set", "dimos.world.x=10", "--set",
         "dimos.world.yaw_deg=90"});
  const Plan plan = some_plan(clock.now());
  ASSERT_TRUE(repeat_until([&] { bus->publish(kPlan, plan); }, [&] { return !paths.empty() && !drawn.empty(); }));
  const nav_msgs::Path& path = paths.back();
  EXPECT_EQ(path.header.frame_id, "world");
  ASSERT_GT(path.poses_length, 10);
  for (const geometry_msgs::PoseStamped& pose : path.poses) {
    const UTime t{pose.header.stamp.sec * 1'000'000LL + pose.header.stamp.nsec / 1000};
    const Vec3 p_D = vec(pose.pose.position);
    EXPECT_LT((Vec3(10.0 - p_D.y(), p_D.x(), p_D.z()) - plan.trajectory.sample(t).p).norm(), 1e-9);
  }
  ASSERT_EQ(drawn.back().markers_length, 2) << "a deletion, and a line";
  const visualization_msgs::Marker& line = drawn.back().markers.at(1);
  EXPECT_EQ(line.type, 4) << "a line strip";
  EXPECT_EQ(line.header.frame_id, "world");
  EXPECT_NEAR(line.pose.orientation.z, -std::sqrt(0.5), 1e-9);
  EXPECT_EQ(dimos.undecoded, 0);
}

TEST_F(DimosProcesses, PassGoalsAndRefuseThoseOutsideTheFlightBoxByName) {
  start({"--goal_request", kGoalChannel, "--set", "uav.flight_box={min: [-10, -10, 0], max: [100, 10, 5]}"});
  std::vector<Goal> goals;
  bus->subscribe(kGoal, [&](const Goal& goal) { goals.push_back(goal); });
  dimos.send(kGoalChannel, pose_at(clock.now(), Vec3(20.0, -3.0, 1.5)));
  ASSERT_TRUE(wait_for([&] { return !goals.empty(); }));
  EXPECT_EQ(goals[0].position, Vec3(20.0, -3.0, 1.5));
  EXPECT_EQ(goals[0].mode, GoalMode::Go);
  dimos.send(kGoalChannel, pose_at(clock.now(), Vec3(20.0, -30.0, 1.5)));
  dimos.send(kGoalChannel, pose_at(clock.now(), Vec3(1.0, 1.0, NAN)));
  dimos.send(kGoalChannel, geometry_msgs::Twist());
  ASSERT_TRUE(wait_for([&] { return says("goal_request: 3 messages were not used"); }));
  dimos.send(kGoalChannel, pose_at(clock.now(), Vec3(1.0, 1.0, 1.0), 0.0, "moon"));
  ASSERT_TRUE(wait_for([&] { return says("no transform leads from moon to tern"); }));
  EXPECT_EQ(goals.back().id, goals[0].id);
  dimos.send("/goal_request#geometry_msgsxPoseStamped", pose_at(clock.now(), Vec3(5.0, 0.0, 1.5)));
  dimos.send(kGoalChannel, pose_at(clock.now(), Vec3(30.0, 0.0, 2.0)));
  ASSERT_TRUE(wait_for([&] { return goals.back().id > goals[0].id; }));
  EXPECT_EQ(goals.back().position, Vec3(30.0, 0.0, 2.0)) << "a channel is a name, not a pattern";
}

/// Poses without velocity, as DimOS's drones send them; a sensor whose frame moves with the vehicle.
TEST_F(DimosProcesses, AreTheVehicleItsDetectorAndItsLidar) {
  start({"--odom", kOdomChannel, "--detections", kDetectionsChannel, "--lidar", kLidarChannel, "--tf", kTfChannel,
         "--set", "dimos.world.yaw_deg=90"});
  std::optional<UavState> state;
  std::optional<VehicleStatus> status;
  std::optional<ObservationSet> frame;
  std::optional<CloudScan> scan;
  bus->subscribe(kUavState, [&](const UavState& s) { state = s; });
  bus->subscribe(kVehicleStatus, [&](const VehicleStatus& s) { status = s; });
  bus->subscribe(kObstacleObservations, [&](const ObservationSet& f) { frame = f; });
  bus->subscribe(kPointCloud, [&](const CloudScan& s) { scan = s; });
  const UTime begin = clock.now();
  const auto send = [&] {
    const UTime now = clock.now();
    const Vec3 p(2.0 * (now - begin).seconds(), 1.0, 2.0);  // 2 m/s north
    dimos.send(kOdomChannel, pose_at(now, p));
    tf2_msgs::TFMessage moving;
    moving.transforms_length = 2;
    moving.transforms.resize(2);
    moving.transforms[0].header = header(now);
    moving.transforms[0].child_frame_id = "base_link";
    set(moving.transforms[0].transform.translation, p);
    moving.transforms[0].transform.rotation = pose_at(now, p).pose.orientation;
    moving.transforms[1] = moving.transforms[0];
    moving.transforms[1].header.frame_id = "moon";
    moving.transforms[1].child_frame_id = "world";  // it lies about what the scenario says
    dimos.send(kTfChannel, moving);
    dimos.send(kDetectionsChannel, boxes_at(now, {{Vec3(10.0, 0.0, 0.0), Vec3(2.0, 1.0, 4.0)}}, "base_link"));
    sensor_msgs::PointCloud2 cloud;
    cloud.header = header(now, "base_link");
    cloud.height = cloud.width = 1;
    cloud.fields_length = 3;
    cloud.fields.resize(3);
    for (int k = 0; k < 3; ++k) cloud.fields[std::size_t(k)] = {std::string(1, char('x' + k)), 4 * k, 7, 1};
    cloud.point_step = cloud.row_step = cloud.data_length = 12;
    const float point[3] = {1.0F, 0.0F, 0.5F};
    cloud.data.assign(reinterpret_cast<const std::uint8_t*>(point), reinterpret_cast<const std::uint8_t*>(point) + 12);
    cloud.is_bigendian = false;
    cloud.is_dense = true;
    dimos.send(kLidarChannel, cloud);
  };
  ASSERT_TRUE(repeat_until(send, [&] {
    return state && frame && scan && status && status->following && state->at - begin > Duration{1'000'000};
  }));
  EXPECT_LT((state->motion.p - Vec3(-1.0, 2.0 * (state->at - begin).seconds(), 2.0)).norm(), 1e-3)
      << "the lie is refused";
  EXPECT_LT((state->motion.v - Vec3(0.0, 2.0, 0.0)).norm(), 1e-2) << "from poses alone";
  EXPECT_NEAR(state->yaw, M_PI / 2, 1e-9);
  EXPECT_EQ(status->mode, "DimOS");
  ASSERT_EQ(frame->detections.size(), 1U);
  EXPECT_NEAR(frame->detections[0].position.y() - frame->sensor_position.y(), 10.0, 1e-6);
  EXPECT_LT((frame->detections[0].half_extents - Vec3(0.5, 1.0, 2.0)).norm(), 1e-9);
  ASSERT_EQ(scan->points.size(), 1U);
  EXPECT_LT((scan->points[0].position.cast<double>() - Vec3(0.0, 1.0, 0.5)).norm(), 1e-6);
  ASSERT_TRUE(wait_for([&] { return !status->following; })) << "the odometry has ended";
  EXPECT_THAT(status->why_not, HasSubstr("the newest odometry is 0."));
}

TEST_F(DimosProcesses, FlySetpointsByVelocitiesAndStopWhenTheyEnd) {
  auto& twists = dimos.keep<geometry_msgs::Twist>(kTwistChannel);
  start({"--odom", "/odom#nav_msgs.Odometry", "--cmd_vel", kTwistChannel, "--set", "dimos.lateral=right"});
  UavState setpoint;
  setpoint.motion.v = Vec3(1.0, 0.5, 0.25);
  setpoint.yaw = 0.2;
  bool sends_setpoints = true;
  const auto send = [&] {
    nav_msgs::Odometry odometry;
    odometry.header = header(clock.now());
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = pose_at(clock.now(), Vec3(3.0, 0.0, 1.0)).pose;
    set(odometry.twist.twist.linear, Vec3::Zero());
    dimos.send("/odom#nav_msgs.Odometry", odometry);
    setpoint.at = clock.now();
    if (sends_setpoints) bus->publish(kSetpoint, setpoint);
  };
  setpoint.motion.p = Vec3(3.5, 0.0, 1.0);
  ASSERT_TRUE(repeat_until(send, [&] { return !twists.empty(); }));
  EXPECT_LT((vec(twists.back().linear) - Vec3(1.5, -0.5, 0.25)).norm(), 1e-9);
  EXPECT_NEAR(twists.back().angular.z, 0.2, 1e-9);
  setpoint.motion.p = Vec3(30.0, 0.0, 1.0);  // 27 m away: it must not be flown
  ASSERT_TRUE(repeat_until(send, [&] { return vec(twists.back().linear).isZero(); }));
  EXPECT_TRUE(repeat_until(send, [&] { return says("more than dimos.far_m = 1 m"); }));
  setpoint.motion.p = Vec3(3.5, 0.0, 1.0);
  ASSERT_TRUE(repeat_until(send, [&] { return std::abs(twists.back().linear.x - 1.5) < 1e-9; }));
  sends_setpoints = false;
  ASSERT_TRUE(repeat_until(send, [&] { return vec(twists.back().linear).isZero(); }));
  sends_setpoints = true;
  ASSERT_TRUE(repeat_until(send, [&] { return std::abs(twists.back().linear.x - 1.5) < 1e-9; }));
  bridge->signal(SIGTERM);
  EXPECT_EQ(bridge->wait(), 0);
  ASSERT_TRUE(wait_for([&] {
    dimos.poll();
    const auto moves = [](const geometry_msgs::Twist& twist) { return !vec(twist.linear).isZero(); };
    return std::find_if(twists.rbegin(), twists.rend(), moves) - twists.rbegin() >= 3;
  })) << "it stops the vehicle before it ends, and one message may be lost";
}

TEST_F(DimosProcesses, LeaveTheVehicleToAnotherProcess) {
  auto& twists = dimos.keep<geometry_msgs::Twist>(kTwistChannel);
  VehicleStatus other;
  other.mode = "OFFBOARD";
  other.armed = other.following = true;
  bus->publish(kVehicleStatus, other);
  start({"--odom", kOdomChannel, "--cmd_vel", kTwistChannel});
  const UTime begin = clock.now();
  UavState setpoint;
  ASSERT_TRUE(repeat_until(
      [&] {
        other.at = setpoint.at = clock.now();
        bus->publish(kVehicleStatus, other);
        bus->publish(kUavState, setpoint);
        bus->publish(kSetpoint, setpoint);
        dimos.send(kOdomChannel, pose_at(clock.now(), Vec3::Zero()));
      },
      [&] { return clock.now() - begin > Duration{1'000'000} && beats.size() > 1; }));
  EXPECT_THAT(beats.back().waiting_for, HasSubstr("another process is this vehicle (VEHICLE_STATUS)"));
  EXPECT_TRUE(twists.empty());
}

/// A peer that floods and lies: bytes that are no messages, and messages that claim anything.
TEST_F(DimosProcesses, SurviveHostileBytes) {
  start({"--odom", kOdomChannel, "--detections", kDetectionsChannel, "--lidar", kLidarChannel, "--tf", kTfChannel,
         "--goal_request", kGoalChannel});
  std::int64_t states = 0;
  bus->subscribe(kUavState, [&](const UavState&) { ++states; });
  struct Liar {
    std::string channel, bytes;
  };
  std::vector<Liar> liars;
  const auto add = [&](const std::string& channel, const auto& message) {
    std::string bytes(std::size_t(message.getEncodedSize()), '\0');
    message.encode(bytes.data(), 0, int(bytes.size()));
    liars.push_back({channel, bytes});
  };
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header(clock.now());
  cloud.fields_length = 3;
  cloud.fields.resize(3);
  cloud.data.resize(std::size_t(cloud.data_length = 480));
  tf2_msgs::TFMessage transforms;
  transforms.transforms_length = 2;
  transforms.transforms.resize(2);
  add(kOdomChannel, pose_at(clock.now(), Vec3::Zero()));
  add(kGoalChannel, pose_at(clock.now(), Vec3::Ones()));
  add(kDetectionsChannel, boxes_at(clock.now(), {{Vec3::Ones(), Vec3::Ones()}, {Vec3::Ones(), Vec3::Ones()}}));
  add(kLidarChannel, cloud);
  add(kTfChannel, transforms);
  std::mt19937_64 rng(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  const int mutations = support::at_effort(100'000);
  for (int k = 0; k < mutations; ++k) {
    const Liar& liar = liars[below(liars.size())];
    std::string bytes = liar.bytes;
    if (below(2) == 0) bytes.resize(below(bytes.size() + 100));
    for (std::size_t n = below(8) + 1; n > 0 && bytes.size() > 8; --n) {
      bytes[8 + below(bytes.size() - 8)] = char(rng() & 0xFF);  // behind the fingerprint
    }
    dimos.send_bytes(liar.channel, bytes);
    if (k % 100 == 0) wait_for([] { return true; });
  }
  states = 0;
  ASSERT_TRUE(
      repeat_until([&] { dimos.send(kOdomChannel, pose_at(clock.now(), Vec3::Zero())); }, [&] { return states > 5; }));
  EXPECT_FALSE(bridge->has_ended()) << bridge->output;
}

TEST_F(DimosProcesses, SayWhichOptionIsWrong) {
  for (const auto& [words, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--odom", "/odom"}, "--odom: \"/odom\" is no channel of DimOS"},
           {{"--odom", "/odom#nav_msgs.Path"}, "must be geometry_msgs.PoseStamped or nav_msgs.Odometry"},
           {{"--cmd_vel", kTwistChannel}, "--cmd_vel: it is a part of the vehicle, which odom reports; add --odom"},
           {{"--set", "dimos.lateral=up"}, "dimos.lateral"},
           {{"--set", "dimos.speed=3"}, "dimos.speed"}}) {
    std::vector<std::string> argv{TERN_DIMOS};
    argv.insert(argv.end(), words.begin(), words.end());
    Child wrong(argv);
    EXPECT_EQ(wrong.wait(), 2) << words[1];
    EXPECT_THAT(wrong.output, HasSubstr(why));
  }
}

}  // namespace
}  // namespace tern::dimos
