// A robot of ROS, made of Fast DDS alone, flies by Tern: odometry, detections and a goal in; setpoints and plans out.
// tern-ros2, tern-executor, tern-planner, tern-predictor and tern-mapper are processes; there is no simulator. Runs
// inside tests/support/hermetic.sh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/ros2/fast_peer.h"
#include "tests/support/bridge_process.h"

namespace tern::ros2 {
namespace {

using namespace channels;
using Setpoint = trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_;

constexpr int kDomain = 9;

template <class Three>
Vec3 vec(const Three& v) {
  return {v.x(), v.y(), v.z()};
}
template <class Three>
void set(Three& to, const Vec3& v) {
  to.x(v.x()), to.y(v.y()), to.z(v.z());
}

/// Flies its newest setpoint. Without one for 0.2 s it brakes.
class Robot {
 public:
  explicit Robot(FastPeer& ros)
      : setpoints_(ros.reader<trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_PubSubType>(
            "rt/setpoint", {.reliable = false, .depth = 1})),
        odometry_(ros.writer<nav_msgs::msg::dds_::Odometry_PubSubType>("rt/odom", {.reliable = false})),
        detections_(ros.writer<vision_msgs::msg::dds_::Detection3DArray_PubSubType>("rt/detections")) {}

  void step(UTime now) {
    if (now < next_) return;
    const double passed = next_ == UTime{} ? 0.0 : kStep.seconds();
    next_ = now + kStep;
    while (const auto setpoint = FastPeer::take<Setpoint>(setpoints_)) {
      p = vec(setpoint->points().at(0).transforms().at(0).translation());
      v = vec(setpoint->points()[0].velocities().at(0).linear());
      told_ = now;
    }
    if (now - told_ > Duration{200'000}) {
      constexpr double kBrake = 4.0;  // m/s²
      v *= std::max(0.0, 1.0 - kBrake * passed / std::max(v.norm(), 1e-9));
      p += passed * v;
    }
    nearest = std::min(nearest, box_distance(p));
    send(now);
  }

  Vec3 p{0.0, 0.0, 1.5}, v = Vec3::Zero();
  double nearest = 1e9;  ///< distance of the box so far, m

 private:
  static constexpr Duration kStep{20'000};
  static constexpr double kYaw = 0.7;  ///< of its body, whatever it flies
  const Vec3 centre_{12.0, 0.0, 2.5}, half_{0.5, 1.5, 2.5};

  [[nodiscard]] double box_distance(const Vec3& x) const {
    return ((x - centre_).cwiseAbs() - half_).cwiseMax(0.0).norm();
  }
  void send(UTime now) {
    std_msgs::msg::dds_::Header_ header;
    header.stamp().sec(static_cast<std::int32_t>(now.us / 1'000'000));
    header.stamp().nanosec(static_cast<std::uint32_t>(now.us % 1'000'000 * 1'000));
    header.frame_id("map");
    nav_msgs::msg::dds_::Odometry_ odometry;
    odometry.header(header);
    odometry.child_frame_id("base_link");
    set(odometry.pose().pose().position(), p);
    odometry.pose().pose().orientation().z(std::sin(kYaw / 2));
    odometry.pose().pose().orientation().w(std::cos(kYaw / 2));
    const Eigen::AngleAxisd R_BW(-kYaw, Vec3::UnitZ());
    set(odometry.twist().twist().linear(), R_BW * v);
    odometry_->write(&odometry);
    vision_msgs::msg::dds_::Detection3DArray_ array;
    array.header(header);
    array.detections().resize(1);
    auto& box = array.detections()[0].bbox();
    set(box.center().position(), centre_);
    box.center().orientation().w(1.0);
    set(box.size(), 2.0 * half_);
    detections_->write(&array);
  }

  fast::DataReader* setpoints_;
  fast::DataWriter *odometry_, *detections_;
  UTime next_, told_;
};

class Ros2Flight : public BridgeFlight {
 protected:
  Ros2Flight() : BridgeFlight({TERN_EXECUTOR, TERN_PLANNER, TERN_PREDICTOR, TERN_MAPPER}, TERN_ROBOT) { start(); }
  void start() {
    start_bridge({TERN_ROS2, "--config", TERN_ROBOT, "--domain", std::to_string(kDomain), "--receive",
                  "odom,detections,goal_pose"});
  }
  /// Lets the robot live until the condition holds.
  bool until(const std::function<bool()>& condition) {
    return live_until([this] { robot.step(clock.now()); }, condition);
  }
  [[nodiscard]] bool rests_at(const Vec3& place) const {
    return (robot.p - place).norm() < 0.05 && robot.v.norm() < 0.01;
  }

  FastPeer ros{kDomain};
  Robot robot{ros};
};

TEST_F(Ros2Flight, ARobotFliesAroundWhatItDetectsToTheGoalOfRos) {
  auto* goals = ros.writer<geometry_msgs::msg::dds_::PoseStamped_PubSubType>("rt/goal_pose");
  auto* trajectories =
      ros.reader<trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_PubSubType>("rt/trajectory", {.depth = 1'000});
  geometry_msgs::msg::dds_::PoseStamped_ goal;
  goal.header().frame_id("map");
  set(goal.pose().position(), Vec3(25.0, 0.0, 1.5));
  goal.pose().orientation().w(1.0);
  UTime next_goal;
  ASSERT_TRUE(until([&] {
    if (clock.now() >= next_goal) {
      goals->write(&goal);
      next_goal = clock.now() + Duration{500'000};
    }
    return robot.p.x() > 6.0;
  })) << last_words();
  EXPECT_GT(robot.v.norm(), 0.5) << "it flies";
  bridge->signal(SIGKILL);
  EXPECT_EQ(bridge->wait(), -SIGKILL);
  ASSERT_TRUE(until([&] { return robot.v.norm() < 0.01; })) << "it comes to rest";
  EXPECT_LT(robot.p.x(), 24.0);
  start();
  ASSERT_TRUE(until([&] { return rests_at(Vec3(25.0, 0.0, 1.5)); })) << last_words();
  EXPECT_GT(robot.nearest, 0.1) << "the body's radius";

  std::size_t compared = 0;
  while (const auto trajectory = FastPeer::take<Setpoint>(trajectories)) {
    const auto& stamp = trajectory->header().stamp();
    const auto plan = plans.find(stamp.sec() * 1'000'000LL + stamp.nanosec() / 1'000);
    if (plan == plans.end()) continue;  // sent before this test received it, or lost on the bus
    ++compared;
    for (const auto& point : trajectory->points()) {
      const auto& after = point.time_from_start();
      const Duration later{after.sec() * 1'000'000LL + after.nanosec() / 1'000};
      const MotionSample wanted = plan->second.sample(plan->second.start + later);
      EXPECT_LT((vec(point.transforms()[0].translation()) - wanted.p).norm(), 1e-9);
      EXPECT_LT((vec(point.velocities()[0].linear()) - wanted.v).norm(), 1e-9);
      EXPECT_LT((vec(point.accelerations()[0].linear()) - wanted.a).norm(), 1e-9);
    }
  }
  EXPECT_GT(compared, 50U);
}

}  // namespace
}  // namespace tern::ros2
