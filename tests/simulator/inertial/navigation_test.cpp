#include "simulator/inertial/navigation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/world/vehicle.h"

namespace tern {
namespace {

constexpr double kStep = 5e-3;
const UTime kBegin{1'000'000};

ImuSpec exact_imu() {
  ImuSpec spec;
  spec.force_noise = spec.force_walk = spec.rate_noise = spec.rate_walk = spec.force_bias = spec.rate_bias = 0.0;
  return spec;
}

/// Flies along x with gentle turns; attitude by a made-up rotation, as the samples need not be flyable.
InertialState truth_at(double t) {
  InertialState s;
  s.p = Vec3(3.0 * t, std::sin(t), 1.0 + 0.2 * std::cos(t));
  s.v = Vec3(3.0, std::cos(t), -0.2 * std::sin(t));
  s.R = rotation_exp(Vec3(0.1 * std::sin(t), 0.1 * std::cos(2 * t), 0.5 * std::sin(0.7 * t)));
  return s;
}

Odometry odometry_of(const InertialState& in_O, UTime at) {
  Odometry odometry;
  odometry.at = at;
  odometry.state = EstimatorState::Tracking;
  odometry.p_OB = in_O.p;
  odometry.v_OB = in_O.v;
  const Eigen::Quaterniond q(in_O.R);
  odometry.q_OB = {q.w(), q.x(), q.y(), q.z()};
  return odometry;
}

/// A navigation that is advanced along truth_at().
struct Flight {
  explicit Flight(const ImuSpec& imu = exact_imu(), double max_sigma_m = 2.0)
      : navigation(imu, {}, max_sigma_m, 1, truth_at(0.0), kBegin) {}
  void fly(double seconds) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n) {
      ++steps;
      navigation.advance(truth(), Vec3::Zero());
    }
  }
  [[nodiscard]] double time() const { return kStep * steps; }
  [[nodiscard]] InertialState truth() const { return truth_at(time()); }
  Navigation navigation;
  int steps = 0;
};

TEST(Navigation, CarriesAnOldOdometryOnToThePresent) {
  Flight flight;
  EXPECT_FALSE(flight.navigation.believed());
  flight.fly(0.4);
  const Odometry odometry = odometry_of(flight.truth(), flight.navigation.now());
  flight.fly(0.15);
  flight.navigation.receive(odometry);
  for (int k = 0; k < 20; ++k) {
    flight.fly(kStep);
    const auto believed = flight.navigation.believed();
    ASSERT_TRUE(believed);
    EXPECT_LT((believed->p - flight.truth().p).norm(), 1e-5);
    EXPECT_LT((believed->v - flight.truth().v).norm(), 1e-9);
    EXPECT_LT((believed->R - flight.truth().R).norm(), 1e-9);
  }
}

TEST(Navigation, TakesTheReportedBiasesOff) {
  ImuSpec biased = exact_imu();
  biased.force_bias = 0.5;
  biased.rate_bias = 0.05;
  const InertialSample bias = SimulatedImu(biased, 1).bias();
  Flight flight(biased);
  flight.fly(0.1);
  Odometry odometry = odometry_of(flight.truth(), flight.navigation.now());
  odometry.gyroscope_bias = bias.rate;
  odometry.accelerometer_bias = bias.force;
  flight.navigation.receive(odometry);
  flight.fly(0.3);
  EXPECT_LT((flight.navigation.believed()->v - flight.truth().v).norm(), 1e-9);
}

TEST(Navigation, ACorrectionOfTheOffsetIsFollowedWithoutAStep) {
  Flight flight;
  flight.fly(0.1);
  flight.navigation.receive(odometry_of(flight.truth(), flight.navigation.now()));
  flight.fly(0.1);
  Odometry corrected = odometry_of(flight.truth(), flight.navigation.now());
  corrected.p_WO = Vec3(0.3, -0.1, 0.2);
  corrected.yaw_WO = 0.02;
  corrected.epoch = 1;
  const double by = corrected.p_WO.norm();
  flight.navigation.receive(corrected);
  EXPECT_NEAR(flight.navigation.outstanding(), by, 0.02);
  Vec3 before = flight.navigation.believed()->p - flight.truth().p;
  for (int k = 0; k < 1000; ++k) {
    flight.fly(kStep);
    const Vec3 now = flight.navigation.believed()->p - flight.truth().p;
    // Beside the correction, the yaw that is already followed turns the velocity.
    EXPECT_LT((now - before).norm(), (Navigation::kCorrectionSpeed + 0.02 * 3.3) * kStep + 1e-9);
    before = now;
  }
  EXPECT_LT(flight.navigation.outstanding(), 1e-6);
  const OdometryOffset offset{corrected.p_WO, corrected.yaw_WO, 1};
  EXPECT_LT((flight.navigation.believed()->p - offset.to_W(PointInO{flight.truth().p}).xyz).norm(), 1e-3);
}

TEST(Navigation, SaysWhyTheEstimateIsNotUsable) {
  Flight flight(exact_imu(), 0.5);
  EXPECT_NE(flight.navigation.trouble().find("no estimate yet"), std::string::npos);
  flight.fly(0.1);
  Odometry odometry = odometry_of(flight.truth(), flight.navigation.now());
  odometry.pose_covariance[7] = 0.04;
  flight.navigation.receive(odometry);
  EXPECT_EQ(flight.navigation.trouble(), "");
  EXPECT_NEAR(flight.navigation.position_sigma(), 0.2, 1e-12);
  flight.fly(0.31);
  EXPECT_NE(flight.navigation.trouble().find("0.3 s old"), std::string::npos) << flight.navigation.trouble();
  EXPECT_EQ(flight.navigation.health(), EstimatorHealth::Lost);
  odometry.at = flight.navigation.now();
  odometry.pose_covariance[7] = 0.36;
  flight.navigation.receive(odometry);
  EXPECT_NE(flight.navigation.trouble().find("0.60 m"), std::string::npos) << flight.navigation.trouble();
  odometry.state = EstimatorState::Lost;
  flight.navigation.receive(odometry);
  EXPECT_NE(flight.navigation.trouble().find("lost"), std::string::npos);
}

TEST(Navigation, AnOldOrFutureOdometryChangesNothing) {
  Flight flight;
  flight.fly(0.2);
  flight.navigation.receive(odometry_of(flight.truth(), flight.navigation.now()));
  const Vec3 before = flight.navigation.believed()->p;
  Odometry wrong = odometry_of(flight.truth(), kBegin);
  wrong.p_OB += Vec3(5, 0, 0);
  flight.navigation.receive(wrong);
  wrong.at = flight.navigation.now() + Duration{1};
  flight.navigation.receive(wrong);
  EXPECT_EQ(flight.navigation.believed()->p, before);
}

TEST(Navigation, BeliefTakesTheTruePoseToTheBelievedOne) {
  Flight flight;
  flight.fly(0.1);
  Odometry odometry = odometry_of(flight.truth(), flight.navigation.now());
  odometry.p_OB += Vec3(0.4, -0.2, 0.1);
  flight.navigation.receive(odometry);
  flight.fly(0.5);
  const InertialState then = flight.truth();
  const UTime at = flight.navigation.now();
  const Vec3 believed = flight.navigation.believed()->p;
  flight.fly(0.3);
  EXPECT_LT((flight.navigation.belief_at(at).of(then.p) - believed).norm(), 1e-12);
}

TEST(Navigation, SamplesAndExposuresHaveTheirRates) {
  Flight flight;
  flight.fly(1.0);
  EXPECT_EQ(flight.navigation.take_samples().size(), 200u);
  EXPECT_EQ(flight.navigation.take_exposures().size(), 20u);
  EXPECT_TRUE(flight.navigation.take_samples().empty());
}

}  // namespace
}  // namespace tern
