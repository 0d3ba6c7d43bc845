// The estimate beside the truth, as the page gets it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "viewer/bridge/scene.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

using Json = nlohmann::json;

constexpr UTime kNow{5'000'000};

/// At (2, 1, 1) in W, with O turned by a quarter. The standard deviations are 0.1, 0.2 and 0.3 m.
Odometry odometry() {
  Odometry odometry;
  odometry.at = kNow;
  odometry.state = EstimatorState::Tracking;
  odometry.p_OB = Vec3(1, 0, 0);
  odometry.p_WO = Vec3(2, 0, 1);
  odometry.yaw_WO = std::acos(0.0);
  for (int k = 0; k < 3; ++k) odometry.pose_covariance[static_cast<std::size_t>(7 * k)] = 0.01 * (k + 1) * (k + 1);
  odometry.tracks = 40;
  return odometry;
}

UavState truth_at(const Vec3& p) {
  UavState truth;
  truth.at = kNow;
  truth.motion.p = p;
  return truth;
}

TEST(EstimateOfAScene, HasThePlaceInTheWorldTheTruthAndTheBound) {
  Scene scene;
  EXPECT_EQ(estimate_json(scene), "null");
  scene.receive(odometry());
  scene.receive_truth(truth_at({2.3, 1, 1.4}));
  EXPECT_TRUE(scene.take_change(Topic::Estimate));
  const Json json = Json::parse(estimate_json(scene));
  EXPECT_NEAR(json["p"][1].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(json["truth"][2].get<double>(), 1.4, 1e-9);
  const double bound = std::sqrt(11.345);
  EXPECT_NEAR(json["half"][0].get<double>(), 0.1 * bound, 1e-3);
  EXPECT_NEAR(json["half"][2].get<double>(), 0.3 * bound, 1e-3);
  const NumberFields numbers = estimate_numbers(scene);
  EXPECT_NEAR(numbers[0].second, 0.5, 1e-9);
  EXPECT_NEAR(numbers[1].second, 0.3 * bound, 1e-9);
}

TEST(EstimateOfAScene, IsNoneWhileTheEstimatorStarts) {
  Scene scene;
  Odometry starting = odometry();
  starting.state = EstimatorState::Starting;
  scene.receive(starting);
  EXPECT_EQ(estimate_json(scene), "null");
  EXPECT_TRUE(std::isnan(estimate_numbers(scene)[0].second));
}

TEST(EstimateOfAScene, PutsFeaturesWhereTheirDisparitySaysAndTellsThoseOnMovers) {
  Scene scene;
  scene.receive(odometry());  // B looks along y of W
  FeatureFrame frame;
  frame.at = kNow;
  frame.q_BC = Eigen::Vector4d(0.5, -0.5, 0.5, -0.5);  // C: right, down, forward
  frame.baseline_m = 0.1;
  frame.features.push_back({1, {0.0, 0.0}, {-0.02, 0.0}, true});  // 5 m ahead
  frame.features.push_back({2, {0.1, 0.0}, {0.05, 0.0}, true});   // 2 m ahead, 0.2 m to the right
  frame.features.push_back({3, {0.0, 0.0}, {0.0, 0.0}, false});   // seen by one camera
  frame.features.push_back({4, {0.0, 0.0}, {-1e-4, 0.0}, true});  // too far
  scene.receive(frame);
  ObstacleTruth obstacles;
  obstacles.at = kNow;
  obstacles.obstacles.push_back({7, Vec3(2, 6.1, 1), Vec3(1, 0, 0), Vec3(0.2, 0.2, 1), false});
  scene.receive(obstacles);
  const Json features = Json::parse(estimate_json(scene))["features"];
  ASSERT_EQ(features.size(), 12U);
  const double expected[] = {2.0, 6.0, 1.0, 1.0, 0.0, 0.0, 2.2, 3.0, 1.0, 0.0, 0.1, 0.0};
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(features[k].get<double>(), expected[k], 2e-3) << k;
}

}  // namespace
}  // namespace tern
