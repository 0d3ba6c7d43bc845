// tern-ros2 as a process, with Fast DDS on ROS's side. Runs inside tests/support/hermetic.sh, which gives it a network
// of its own. The test plays the rest of Tern.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include "tests/ros2/fast_peer.h"
#include "tests/support/bridge_process.h"
#include "tests/support/effort.h"
#include "tests/support/straight_plan.h"

namespace tern::ros2 {
namespace {

using ::testing::HasSubstr;
using namespace channels;

constexpr int kDomain = 7;

class Ros2Processes : public BridgeProcess {
 protected:
  void start(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {TERN_ROS2, "--domain", std::to_string(kDomain)});
    start_bridge_and_wait(more);
  }
  void stamp(std_msgs::msg::dds_::Header_& header) const {
    const std::int64_t now_us = clock.now().us;
    header.stamp().sec(static_cast<std::int32_t>(now_us / 1'000'000));
    header.stamp().nanosec(static_cast<std::uint32_t>(now_us % 1'000'000 * 1'000));
  }
  geometry_msgs::msg::dds_::TransformStamped_ transform(const std::string& parent, const std::string& child,
                                                        const Vec3& p, double yaw) const {
    geometry_msgs::msg::dds_::TransformStamped_ t;
    t.header().frame_id(parent);
    stamp(t.header());
    t.child_frame_id(child);
    t.transform().translation().x(p.x());
    t.transform().translation().y(p.y());
    t.transform().translation().z(p.z());
    t.transform().rotation().z(std::sin(yaw / 2));
    t.transform().rotation().w(std::cos(yaw / 2));
    return t;
  }
  UavState some_state() {
    UavState state;
    state.at = clock.now();
    state.motion.p = Vec3(1.5, -2.0, 3.25);
    state.motion.v = Vec3(2.0, 1.0, -0.5);
    state.yaw = 0.8;
    return state;
  }

  FastPeer ros{kDomain};
};

TEST_F(Ros2Processes, SendStatesPlansAndDrawingsAsRosKnowsThem) {
  using namespace nav_msgs::msg::dds_;
  start();
  auto* odom = ros.reader<Odometry_PubSubType>("rt/odom");
  auto* paths = ros.reader<Path_PubSubType>("rt/plan", {.reliable = false});
  auto* markers = ros.reader<visualization_msgs::msg::dds_::MarkerArray_PubSubType>("rt/tern/plan");
  auto* trajectories = ros.reader<trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_PubSubType>("rt/trajectory");

  UavState state;
  std::optional<Odometry_> odometry;
  ASSERT_TRUE(repeat_until(
      [&] {
        state = some_state();
        bus->publish(kUavState, state);
      },
      [&] { return (odometry = FastPeer::take<Odometry_>(odom)).has_value(); }));
  EXPECT_EQ(odometry->header().frame_id(), "map");
  EXPECT_EQ(odometry->child_frame_id(), "base_link");
  EXPECT_EQ(odometry->pose().pose().position().y(), -2.0);
  EXPECT_EQ(odometry->pose().pose().orientation().z(), std::sin(0.4));
  const auto& v = odometry->twist().twist().linear();
  EXPECT_NEAR(v.x(), std::cos(0.8) * 2.0 + std::sin(0.8) * 1.0, 1e-12) << "in base_link";
  EXPECT_NEAR(v.y(), -std::sin(0.8) * 2.0 + std::cos(0.8) * 1.0, 1e-12);
  EXPECT_EQ(v.z(), -0.5);

  const Plan plan = some_plan(clock.now());
  std::optional<Path_> path;
  std::optional<trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_> trajectory;
  std::optional<visualization_msgs::msg::dds_::MarkerArray_> drawn;
  ASSERT_TRUE(repeat_until([&] { bus->publish(kPlan, plan); },
                           [&] {
                             if (!path) path = FastPeer::take<Path_>(paths);
                             if (!trajectory) {
                               trajectory =
                                   FastPeer::take<trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_>(trajectories);
                             }
                             if (!drawn) drawn = FastPeer::take<visualization_msgs::msg::dds_::MarkerArray_>(markers);
                             return path && trajectory && drawn;
                           }));
  ASSERT_EQ(path->poses().size(), trajectory->points().size());
  for (std::size_t k = 0; k < path->poses().size(); ++k) {
    const auto& at = path->poses()[k].header().stamp();
    const UTime t{at.sec() * 1'000'000LL + at.nanosec() / 1000};
    const MotionSample wanted = plan.trajectory.sample(t);
    const auto& p = path->poses()[k].pose().position();
    EXPECT_LT((Vec3(p.x(), p.y(), p.z()) - wanted.p).norm(), 1e-9);
    const auto& a = trajectory->points()[k].accelerations()[0].linear();
    EXPECT_LT((Vec3(a.x(), a.y(), a.z()) - wanted.a).norm(), 1e-9);
  }
  EXPECT_EQ(drawn->markers().at(1).type(), 4) << "a line strip";
  EXPECT_GT(drawn->markers().at(1).points().size(), 10U);
}

/// Names, types, quality of service and user data as rmw_cyclonedds_cpp gives them to its own publishers (Jazzy).
TEST_F(Ros2Processes, AnnounceWritersAsRmwDoes) {
  start({"--namespace", "/drone1", "--remap", "odom:=/robot/odometry"});
  const std::string known = "typehash=RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0;";
  ASSERT_TRUE(wait_for([&] { return ros.writers_seen() >= 14; }));
  const auto odometry = ros.seen("rt/robot/odometry"), map = ros.seen("rt/drone1/map_cloud"), tf = ros.seen("rt/tf");
  ASSERT_TRUE(odometry && map && tf);
  EXPECT_EQ(odometry->type, "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(odometry->user_data, known);
  EXPECT_TRUE(odometry->reliable);
  EXPECT_FALSE(odometry->latched);
  EXPECT_EQ(map->type, "sensor_msgs::msg::dds_::PointCloud2_");
  EXPECT_TRUE(map->latched);
  EXPECT_EQ(tf->type, "tf2_msgs::msg::dds_::TFMessage_");
  EXPECT_FALSE(ros.seen("rt/clock")) << "the flight is not slowed: ROS's clock is the system's";
}

TEST_F(Ros2Processes, KeepTheNewestGoalForReadersThatComeLater) {
  start();
  Goal goal;
  goal.id = 3;
  goal.position = Vec3(10.0, 2.0, 1.5);
  bus->publish(kGoal, goal);
  UavState state = some_state();
  auto* odom = ros.reader<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom");
  ASSERT_TRUE(repeat_until([&] { bus->publish(kUavState, state); },
                           [&] { return FastPeer::take<nav_msgs::msg::dds_::Odometry_>(odom).has_value(); }));
  auto* goals = ros.reader<geometry_msgs::msg::dds_::PoseStamped_PubSubType>("rt/goal_pose", {.latched = true});
  std::optional<geometry_msgs::msg::dds_::PoseStamped_> seen;
  ASSERT_TRUE(
      wait_for([&] { return (seen = FastPeer::take<geometry_msgs::msg::dds_::PoseStamped_>(goals)).has_value(); }));
  EXPECT_EQ(seen->pose().position().x(), 10.0);
}

geometry_msgs::msg::dds_::PoseStamped_ pose_at(double x, double y, double z, const std::string& frame = "map") {
  geometry_msgs::msg::dds_::PoseStamped_ pose;
  pose.header().frame_id(frame);
  pose.pose().position().x(x);
  pose.pose().position().y(y);
  pose.pose().position().z(z);
  pose.pose().orientation().w(1.0);
  return pose;
}

TEST_F(Ros2Processes, PassGoalsOnceAndRefuseThoseOutsideTheFlightBox) {
  start({"--receive", "goal_pose", "--set", "uav.flight_box={min: [-10, -10, 0], max: [100, 10, 5]}"});
  std::vector<Goal> goals;
  bus->subscribe(kGoal, [&](const Goal& goal) { goals.push_back(goal); });
  auto* out = ros.writer<geometry_msgs::msg::dds_::PoseStamped_PubSubType>("rt/goal_pose");
  ASSERT_TRUE(wait_for([&] { return FastPeer::is_matched(out); }));
  auto goal = pose_at(20.0, -3.0, 1.5);
  // A volatile reader may discover the writer later than the writer the reader, and miss what was sent in between.
  ASSERT_TRUE(repeat_until([&] { out->write(&goal); }, [&] { return !goals.empty(); }));
  EXPECT_EQ(goals[0].position, Vec3(20.0, -3.0, 1.5));
  EXPECT_EQ(goals[0].mode, GoalMode::Go);
  out->write(&goal);
  auto outside = pose_at(20.0, -30.0, 1.5), nowhere = pose_at(20.0, std::nan(""), 1.5), lost = pose_at(1, 1, 1, "moon");
  for (auto* wrong : {&outside, &nowhere, &lost}) out->write(wrong);
  ASSERT_TRUE(wait_for([&] {
    return std::any_of(beats.begin(), beats.end(), [](const Heartbeat& beat) {
      return beat.waiting_for.find("/goal_pose: 3 messages were not used") != std::string::npos;
    });
  }));
  EXPECT_THAT(beats.back().waiting_for, HasSubstr("no transform leads from moon to map"));
  for (const Goal& repeated : goals) EXPECT_EQ(repeated.id, goals[0].id) << "the same position is the same goal";
  EXPECT_GT(goals.size(), 2U) << "it is repeated until the executor repeats it";
  auto next = pose_at(30.0, 0.0, 2.0);
  out->write(&next);
  ASSERT_TRUE(wait_for([&] { return goals.back().id > goals[0].id; }));
  EXPECT_EQ(goals.back().position, Vec3(30.0, 0.0, 2.0));
  EXPECT_EQ(ros.seen("rt/goal_pose")->user_data, "") << "the test's own writer: a topic that is received is not sent";
}

TEST_F(Ros2Processes, LoseNoMessageForAReliableReader) {
  const int all = support::at_effort(10'000);
  start();
  auto* reader = ros.reader<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom", {.depth = 1'000});
  std::vector<double> received;
  const auto take = [&] {
    while (const auto odometry = FastPeer::take<nav_msgs::msg::dds_::Odometry_>(reader)) {
      received.push_back(odometry->pose().pose().position().x());
    }
  };
  const auto send = [&](double x) {
    UavState state = some_state();
    state.motion.p.x() = x;
    bus->publish(kUavState, state);
  };
  ASSERT_TRUE(repeat_until([&] { send(-1.0); },
                           [&] {
                             take();
                             return !received.empty();
                           }))
      << "the reader is matched";
  int sent = 0;
  ASSERT_TRUE(live_until(
      [&] {
        if (sent < all) send(sent++);
      },
      [&] {
        take();
        return received.back() == all - 1;
      }));
  received.erase(received.begin(), std::find(received.begin(), received.end(), 0.0));
  ASSERT_EQ(received.size(), static_cast<std::size_t>(all));
  for (int k = 0; k < all; ++k) ASSERT_EQ(received[static_cast<std::size_t>(k)], k);
}

/// Without a peer in this namespace, whose own packets would count as well.
class Ros2Alone : public BridgeProcess {};

TEST_F(Ros2Alone, StaysOnThisHostUnlessAsked) {
  const auto run = [](const std::string& command) { return std::system(command.c_str()) == 0; };
  ASSERT_TRUE(run("ip link add wire0 type veth peer name wire1"));
  ASSERT_TRUE(run("[ ! -e /proc/sys/net/ipv6 ] || sysctl -qw net.ipv6.conf.wire0.disable_ipv6=1"));
  ASSERT_TRUE(run("ip addr add 10.9.8.7/24 dev wire0 && ip link set wire1 up && ip link set wire0 up"));
  const auto packets_sent = [] {
    std::ifstream file("/proc/net/dev");
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string name;
      std::int64_t number[10] = {};
      words >> name;
      for (std::int64_t& n : number) words >> n;
      if (name == "wire0:") return number[9];
    }
    return std::int64_t{-1};
  };
  const auto beats_until = [&](std::size_t count) { return wait_for([&] { return beats.size() >= count; }); };
  std::vector<std::string> command{TERN_ROS2, "--domain", std::to_string(kDomain)};
  start_bridge_and_wait(command);
  ASSERT_TRUE(beats_until(6)) << "LCM has joined its group on all interfaces, twice";
  const std::int64_t before = packets_sent();
  ASSERT_GE(before, 0);
  ASSERT_TRUE(beats_until(12)) << "3 s: DDS announces itself each second";
  EXPECT_EQ(packets_sent(), before);
  end_and_show(*bridge);
  command.insert(command.end(), {"--interface", "wire0"});
  start_bridge_and_wait(command);
  ASSERT_TRUE(beats_until(beats.size() + 6));
  const std::int64_t asked = packets_sent();
  EXPECT_TRUE(wait_for([&] { return packets_sent() > asked; }));
}

TEST_F(Ros2Processes, OutliveAPeerThatLeaves) {
  start({"--receive", "goal_pose,odom"});
  std::vector<Goal> goals;
  bus->subscribe(kGoal, [&](const Goal& goal) { goals.push_back(goal); });
  for (double x = 1.0; x < 4.0; x += 1.0) {
    FastPeer guest(kDomain);
    auto* out = guest.writer<geometry_msgs::msg::dds_::PoseStamped_PubSubType>("rt/goal_pose");
    auto* odom = guest.writer<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom", {.reliable = false});
    ASSERT_TRUE(wait_for([&] { return FastPeer::is_matched(odom); }));
    auto goal = pose_at(x, 0.0, 1.0);
    ASSERT_TRUE(
        repeat_until([&] { out->write(&goal); }, [&] { return !goals.empty() && goals.back().position.x() == x; }));
  }
}

TEST_F(Ros2Processes, ReceiveNothingUnlessAsked) {
  start();
  ASSERT_TRUE(wait_for([&] { return ros.seen("rt/goal_pose").has_value(); }));
  auto* goals = ros.writer<geometry_msgs::msg::dds_::PoseStamped_PubSubType>("rt/goal_pose");
  auto* detections = ros.writer<vision_msgs::msg::dds_::Detection3DArray_PubSubType>("rt/detections");
  auto* seen = ros.reader<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom");
  ASSERT_TRUE(repeat_until([&] { bus->publish(kUavState, some_state()); },
                           [&] { return FastPeer::take<nav_msgs::msg::dds_::Odometry_>(seen).has_value(); }));
  EXPECT_FALSE(FastPeer::is_matched(goals));
  EXPECT_FALSE(FastPeer::is_matched(detections));
}

/// Odometry in a frame of its own and detections of a sensor that is mounted on the vehicle.
TEST_F(Ros2Processes, AreTheVehicleAndItsDetector) {
  start({"--receive", "odom,detections"});
  std::optional<UavState> state;
  std::optional<VehicleStatus> status;
  std::optional<ObservationSet> frame;
  bus->subscribe(kUavState, [&](const UavState& s) { state = s; });
  bus->subscribe(kVehicleStatus, [&](const VehicleStatus& s) { status = s; });
  bus->subscribe(kObstacleObservations, [&](const ObservationSet& f) { frame = f; });
  auto* tf = ros.writer<tf2_msgs::msg::dds_::TFMessage_PubSubType>("rt/tf");
  auto* tf_static =
      ros.writer<tf2_msgs::msg::dds_::TFMessage_PubSubType>("rt/tf_static", {.latched = true, .depth = 1});
  auto* odom = ros.writer<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom");
  auto* detections =
      ros.writer<vision_msgs::msg::dds_::Detection3DArray_PubSubType>("rt/detections", {.reliable = false});
  tf2_msgs::msg::dds_::TFMessage_ mounted;
  mounted.transforms().push_back(transform("base_link", "lidar", Vec3(0.5, 0.0, 0.0), 0.0));
  mounted.transforms().push_back(transform("map", "odom", Vec3(100.0, 0.0, 0.0), M_PI / 2));
  tf_static->write(&mounted);
  const auto send = [&] {
    tf2_msgs::msg::dds_::TFMessage_ moving;
    moving.transforms().push_back(transform("odom", "base_link", Vec3(4.0, 0.0, 2.0), 0.0));
    tf->write(&moving);
    nav_msgs::msg::dds_::Odometry_ o;
    o.header().frame_id("odom");
    stamp(o.header());
    o.child_frame_id("base_link");
    o.pose().pose().position().x(4.0);
    o.pose().pose().position().z(2.0);
    o.pose().pose().orientation().w(1.0);
    o.pose().covariance()[0] = 0.04;
    o.twist().twist().linear().x(3.0);
    odom->write(&o);
    vision_msgs::msg::dds_::Detection3DArray_ array;
    array.header(moving.transforms()[0].header());
    array.header().frame_id("lidar");
    array.detections().resize(1);
    array.detections()[0].id("17");
    array.detections()[0].bbox().center().position().x(10.0);
    array.detections()[0].bbox().center().orientation().w(1.0);
    array.detections()[0].bbox().size().x(2.0);
    array.detections()[0].bbox().size().y(1.0);
    array.detections()[0].bbox().size().z(4.0);
    detections->write(&array);
  };
  ASSERT_TRUE(repeat_until(send, [&] { return state && frame && status && status->following; }));
  EXPECT_LT((state->motion.p - Vec3(100.0, 4.0, 2.0)).norm(), 1e-9);
  EXPECT_LT((state->motion.v - Vec3(0.0, 3.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(state->yaw, M_PI / 2, 1e-9);
  EXPECT_LT((status->position_sigma - Vec3(0.0, 0.2, 0.0)).norm(), 1e-9) << "turned with the frame";
  EXPECT_LT((frame->sensor_position - Vec3(100.0, 4.5, 2.0)).norm(), 1e-9);
  ASSERT_EQ(frame->detections.size(), 1U);
  EXPECT_LT((frame->detections[0].position - Vec3(100.0, 14.5, 2.0)).norm(), 1e-9);
  EXPECT_LT((frame->detections[0].half_extents - Vec3(0.5, 1.0, 2.0)).norm(), 1e-9);
  EXPECT_EQ(frame->detections[0].track_id, 17);
  ASSERT_TRUE(wait_for([&] { return !status->following; })) << "the odometry has ended";
  EXPECT_THAT(status->why_not, HasSubstr("the newest odometry is 0."));
}

/// A publisher that has sent its OctoMap before the bridge started, as octomap_server with a file does. The place of
/// its frame comes later.
TEST_F(Ros2Processes, PassALatchedOctoMapOnAgainAndAgain) {
  auto* octomap =
      ros.writer<octomap_msgs::msg::dds_::Octomap_PubSubType>("rt/octomap_binary", {.latched = true, .depth = 1});
  octomap_msgs::msg::dds_::Octomap_ message;
  message.header().frame_id("lab");
  message.binary(true);
  message.id("OcTree");
  message.resolution(0.05);
  for (int k = 0; k < 100'000; ++k) message.data().push_back(static_cast<char>(k * 37));
  octomap->write(&message);
  std::vector<MapFile> parts;
  bus->subscribe(kMapFile, [&](const MapFile& part) { parts.push_back(part); });
  start({"--receive", "octomap_binary"});
  ASSERT_TRUE(wait_for([&] {
    return std::any_of(beats.begin(), beats.end(), [](const Heartbeat& beat) {
      return beat.waiting_for.find("no transform leads from lab to map") != std::string::npos;
    });
  })) << bridge->output;
  auto* tf_static =
      ros.writer<tf2_msgs::msg::dds_::TFMessage_PubSubType>("rt/tf_static", {.latched = true, .depth = 1});
  tf2_msgs::msg::dds_::TFMessage_ place;
  place.transforms().push_back(transform("map", "lab", Vec3(3.0, 0.0, 0.0), 0.0));
  tf_static->write(&place);
  ASSERT_TRUE(wait_for([&] { return parts.size() >= 4; })) << bridge->output << "two parts, twice";
  EXPECT_EQ(parts[0].parts, 2);
  EXPECT_EQ(parts[0].origin, Vec3(3.0, 0.0, 0.0));
  EXPECT_EQ(parts[2].at, parts[0].at) << "the same file again";
  std::string file(parts[0].bytes.begin(), parts[0].bytes.end());
  file.append(parts[1].bytes.begin(), parts[1].bytes.end());
  const std::string head = "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.05\ndata\n";
  EXPECT_EQ(file, head + std::string(message.data().begin(), message.data().end()));
}

/// A peer that floods and lies: bytes that are no messages, and messages that claim anything.
TEST_F(Ros2Processes, SurviveHostileBytes) {
  start({"--receive", "goal_pose,odom,following,detections,cloud,octomap_binary"});
  std::int64_t states = 0;
  bus->subscribe(kUavState, [&](const UavState&) { ++states; });
  nav_msgs::msg::dds_::Odometry_ odometry;
  odometry.header().frame_id("map");
  odometry.pose().pose().orientation().w(1.0);
  vision_msgs::msg::dds_::Detection3DArray_ detections;
  detections.header().frame_id("map");
  detections.detections().resize(2);
  sensor_msgs::msg::dds_::PointCloud2_ cloud;
  cloud.header().frame_id("map");
  cloud.fields().resize(3);
  cloud.data().resize(480);
  tf2_msgs::msg::dds_::TFMessage_ transforms;
  transforms.transforms().resize(2);
  std_msgs::msg::dds_::Bool_ following;
  octomap_msgs::msg::dds_::Octomap_ octomap;
  octomap.header().frame_id("map");
  octomap.id("OcTree");
  octomap.resolution(0.1);
  octomap.data().resize(50);
  auto goal = pose_at(1.0, 1.0, 1.0);
  struct Liar {
    fast::DataWriter* writer;
    std::string bytes;
  };
  std::vector<Liar> liars;
  const auto add = [&](auto&& type, auto& message, const std::string& topic, Wish wish = {}) {
    liars.push_back({ros.writer(fast::TypeSupport(new HostileType(type)), topic, wish), cdr_of(type, &message)});
  };
  add(nav_msgs::msg::dds_::Odometry_PubSubType(), odometry, "rt/odom");
  add(geometry_msgs::msg::dds_::PoseStamped_PubSubType(), goal, "rt/goal_pose");
  add(vision_msgs::msg::dds_::Detection3DArray_PubSubType(), detections, "rt/detections");
  add(sensor_msgs::msg::dds_::PointCloud2_PubSubType(), cloud, "rt/cloud");
  add(std_msgs::msg::dds_::Bool_PubSubType(), following, "rt/following");
  add(tf2_msgs::msg::dds_::TFMessage_PubSubType(), transforms, "rt/tf");
  add(octomap_msgs::msg::dds_::Octomap_PubSubType(), octomap, "rt/octomap_binary", {.latched = true, .depth = 1});
  for (const Liar& liar : liars) ASSERT_TRUE(wait_for([&] { return FastPeer::is_matched(liar.writer); }));
  std::mt19937_64 rng(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  const int mutations = support::at_effort(100'000);
  for (int k = 0; k < mutations; ++k) {
    const Liar& liar = liars[below(liars.size())];
    std::string bytes = liar.bytes;
    if (below(2) == 0) bytes.resize(below(bytes.size() + 100));
    for (std::size_t n = below(8) + 1; n > 0 && !bytes.empty(); --n) bytes[below(bytes.size())] = char(rng() & 0xFF);
    liar.writer->write(&bytes);
    if (k % 100 == 0) wait_for([] { return true; });
  }
  states = 0;
  nav_msgs::msg::dds_::Odometry_PubSubType honest;
  ASSERT_TRUE(repeat_until(
      [&] {
        stamp(odometry.header());
        std::string bytes = cdr_of(honest, &odometry);
        liars[0].writer->write(&bytes);
      },
      [&] { return states > 5; }));
  EXPECT_FALSE(bridge->has_ended()) << bridge->output;
}

TEST_F(Ros2Processes, SayThatAReaderDoesNotFitAndEndWhenAsked) {
  start();
  auto* odom = ros.reader<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom", {.latched = true});
  ASSERT_NE(odom, nullptr);
  ASSERT_TRUE(wait_for([&] {
    return beats.back().waiting_for.find("/odom: the QoS of a reader does not fit a reliable, volatile writer") !=
           std::string::npos;
  }));
  bridge->signal(SIGTERM);
  EXPECT_EQ(bridge->wait(), 0);
}

TEST_F(Ros2Processes, SayWhichOptionIsWrong) {
  for (const auto& [words, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--send", "odom,odem"}, "--send odem: there is no such topic; there are /odom"},
           {{"--remap", "odom=/x"}, "--remap odom=/x: must be TOPIC:=/NAME"},
           {{"--remap", "odom:=/1x"}, "/1x is no full name of ROS"},
           {{"--namespace", "drone"}, "--namespace drone: must be a name of ROS"},
           {{"--receive", "plan"}, "--receive plan: there is no such topic; there are /goal_pose, /odom"},
           {{"--receive", "following"}, "add odom"},
           {{"--interface", "nosuch0"}, "nosuch0"},
           {{"--domain", "233"}, "must be a whole number of 0 to 232"}}) {
    std::vector<std::string> argv{TERN_ROS2};
    argv.insert(argv.end(), words.begin(), words.end());
    Child wrong(argv);
    EXPECT_EQ(wrong.wait(), 2) << words[1];
    EXPECT_THAT(wrong.output, HasSubstr(why));
  }
}

}  // namespace
}  // namespace tern::ros2
