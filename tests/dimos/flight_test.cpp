// A drone of DimOS flies by Tern through thirty boxes that it detects: poses, boxes and a goal in; velocities and paths
// out. tern-dimos, tern-executor, tern-planner, tern-predictor and tern-mapper are processes; there is no simulator.
// Runs inside tests/support/hermetic.sh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/dimos/dimos_peer.h"
#include "tests/support/bridge_process.h"

namespace tern::dimos {
namespace {

using namespace channels;

using BoxList = std::vector<std::pair<Vec3, Vec3>>;  ///< centre and whole extents

/// Thirty pillars in DimOS's world, 8 m to either side of the way north, clear of its ends.
BoxList some_boxes() {
  std::mt19937_64 rng(5);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
  BoxList boxes;
  while (boxes.size() < 30) {
    const double x = between(4.0, 15.0), y = between(-8.0, 8.0), width = between(0.4, 1.0);
    boxes.emplace_back(Vec3(x, y, 1.5), Vec3(width, width, 3.0));
  }
  return boxes;
}

/// As DimOS's MAVLink drone: it takes velocities of its body (x ahead, y to the right), keeps its height and yaw, and
/// reports its pose at 30 Hz. Its autopilot follows a velocity with a lag, and holds the last one for a second.
class Drone {
 public:
  explicit Drone(DimosPeer& dimos) : dimos_(dimos), twists_(dimos.keep<geometry_msgs::Twist>(kTwistChannel)) {}

  void step(UTime now) {
    dimos_.poll();
    for (; !twists_.empty(); twists_.pop_front()) {
      const auto& linear = twists_.front().linear;
      wish_ = Eigen::AngleAxisd(kYaw, Vec3::UnitZ()) * Vec3(linear.x, -linear.y, 0.0);
      told_ = now;
    }
    if (now - told_ > Duration{1'000'000}) wish_.setZero();
    if (now < next_) return;
    if (next_ != UTime{}) {
      const double dt = kStep.seconds();
      v += dt / kLag * (wish_ - v);
      p += dt * v;
    }
    next_ = now + kStep;
    for (const auto& [centre, size] : boxes) {
      nearest = std::min(nearest, ((p - centre).cwiseAbs() - size / 2).cwiseMax(0.0).norm());
    }
    if (++steps_ % 3 != 0) return;
    dimos_.send(kOdomChannel, pose_at(now, p, kYaw));
    dimos_.send(kDetectionsChannel, boxes_at(now, boxes));
  }

  const BoxList boxes = some_boxes();
  Vec3 p{0.0, 0.0, 1.5}, v = Vec3::Zero();  ///< DimOS's world
  double nearest = 1e9;                     ///< distance of its centre from the boxes so far, m

 private:
  static constexpr Duration kStep{11'000};
  static constexpr double kLag = 0.2;   // s
  static constexpr double kYaw = -0.7;  ///< whatever it flies

  DimosPeer& dimos_;
  std::deque<geometry_msgs::Twist>& twists_;
  Vec3 wish_ = Vec3::Zero();
  UTime next_, told_;
  int steps_ = 0;
};

class DimosFlight : public BridgeFlight {
 protected:
  DimosFlight() : BridgeFlight({TERN_EXECUTOR, TERN_PLANNER, TERN_PREDICTOR, TERN_MAPPER}, TERN_DRONE) { start(); }
  void start() {
    start_bridge({TERN_DIMOS, "--config", TERN_DRONE, "--dimos_url", kDimosUrl, "--odom", kOdomChannel, "--detections",
                  kDetectionsChannel, "--goal_request", kGoalChannel, "--cmd_vel", kTwistChannel, "--path",
                  kPathChannel});
  }
  /// Lets the drone live until the condition holds.
  bool until(const std::function<bool()>& condition) {
    return live_until([this] { drone.step(clock.now()); }, condition);
  }

  DimosPeer dimos;
  Drone drone{dimos};
};

TEST_F(DimosFlight, ADroneFliesAroundWhatItDetectsToTheGoalOfDimos) {
  auto& paths = dimos.keep<nav_msgs::Path>(kPathChannel);
  const Vec3 goal(18.0, 0.0, 1.5);
  UTime next_goal;
  ASSERT_TRUE(until([&] {
    if (clock.now() >= next_goal) {
      dimos.send(kGoalChannel, pose_at(clock.now(), goal));
      next_goal = clock.now() + Duration{500'000};
    }
    return drone.p.x() > 5.0;
  })) << last_words();
  EXPECT_GT(drone.v.norm(), 0.5) << "it flies";
  bridge->signal(SIGTERM);
  ASSERT_TRUE(until([&] { return drone.v.norm() < 0.01; })) << "it comes to rest";
  EXPECT_EQ(bridge->wait(), 0);
  EXPECT_LT(drone.p.x(), 12.0);
  start();
  ASSERT_TRUE(until([&] { return (drone.p - goal).norm() < 0.1 && drone.v.norm() < 0.05; })) << last_words();
  EXPECT_GT(drone.nearest, 0.3) << "the body's radius";

  std::size_t compared = 0;
  for (const nav_msgs::Path& path : paths) {
    const auto plan = plans.find(path.header.stamp.sec * 1'000'000LL + path.header.stamp.nsec / 1'000);
    if (plan == plans.end()) continue;  // sent before this test received it, or lost on the bus
    ++compared;
    for (const geometry_msgs::PoseStamped& pose : path.poses) {
      const UTime at{pose.header.stamp.sec * 1'000'000LL + pose.header.stamp.nsec / 1'000};
      const Vec3 p_D = vec(pose.pose.position);
      EXPECT_LT((Vec3(-p_D.y(), p_D.x(), p_D.z()) - plan->second.sample(at).p).norm(), 1e-9);
    }
  }
  EXPECT_GT(compared, 50U);
  EXPECT_EQ(dimos.undecoded, 0);
}

}  // namespace
}  // namespace tern::dimos
