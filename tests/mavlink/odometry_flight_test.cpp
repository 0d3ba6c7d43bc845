// Flights with the simulated autopilot whose ODOMETRY is Tern's: a reset, a death, an open covariance, a companion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

BridgeConfig config() { return {.start = Start::Arm, .set_parameters = true, .odometry = OdometrySource::Autopilot}; }
SimulatedAutopilotConfig tuned() {
  SimulatedAutopilotConfig autopilot;
  autopilot.tuned = true;
  return autopilot;
}

class OdometryFlight : public testing::Test {
 protected:
  /// Begins to fly along x.
  void begin() {
    ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << why_not();
    flight.path = along;
    flight.run(4.0);
    ASSERT_TRUE(flight.following());
  }
  std::string why_not() const { return flight.bridge.status(flight.now).why_not; }
  Vec3 believed() const { return flight.bridge.state()->motion.p; }
  Vec3 flown() const { return flight.autopilot.model().truth().motion.p; }

  FlightInMemory flight{config(), tuned()};
};

TEST_F(OdometryFlight, StatesTheDriftOfASecondAndNotTheWholeError) {
  begin();
  flight.set_parameter("SIM_ODO_SIGMA", 0.6F);
  flight.set_parameter("SIM_ODO_VEL", 0.05F);
  flight.run(1.5);
  EXPECT_TRUE(flight.following()) << why_not();
  EXPECT_NEAR(flight.bridge.status(flight.now).position_sigma.x(), std::sqrt(6.0) * 0.05, 1e-3)
      << "its velocity is the body's, with open correlations";
  EXPECT_NEAR(flight.bridge.estimate()->pose_covariance[0], 6.0 * 0.36, 1e-3);
  EXPECT_LT(flight.now - flight.bridge.estimate()->at, Duration{50'000});
}

TEST_F(OdometryFlight, AResetOfHalfAMetreMovesNeitherVehicleNorSetpointsAtOnce) {
  begin();
  Vec3 before_flown = flown(), before = believed(), largest = Vec3::Zero();
  double largest_step = 0.0;
  flight.each = [&] {
    const Vec3 step = believed() - before - Vec3(0.004, 0.0, 0.0);
    largest_step = std::max(largest_step, step.norm());
    before = believed();
    largest = largest.cwiseMax((flown() - before_flown - Vec3(0.004, 0.0, 0.0)).cwiseAbs());
    before_flown = flown();
  };
  flight.set_parameter("SIM_EST_JUMP", 0.5F);
  flight.run(0.5);
  EXPECT_TRUE(flight.following());
  EXPECT_EQ(flight.bridge.status(flight.now).resets, 0) << "UAV_STATE has not jumped";
  EXPECT_EQ(flight.bridge.estimate()->epoch, 1);
  EXPECT_LT(largest_step, 0.03) << "at 50 Hz and 2 m/s, between two estimates";
  EXPECT_LT((flown() - believed()).norm(), 0.12) << "it believes to be where it is, nearly";
  flight.run(6.0);
  EXPECT_NEAR((flown() - believed()).norm(), 0.5, 0.05) << "now it flies by the new estimate";
  EXPECT_LT(largest.maxCoeff(), 1e-3) << "at no more than half a metre per second beside its way";
  EXPECT_TRUE(flight.following());
}

TEST_F(OdometryFlight, AResetOfTwoMetresJumpsAndCounts) {
  begin();
  flight.set_parameter("SIM_EST_JUMP", 2.0F);
  flight.run(0.1);
  EXPECT_EQ(flight.bridge.status(flight.now).resets, 1);
  EXPECT_NEAR((flown() - believed()).norm(), 2.0, 0.1);
}

TEST_F(OdometryFlight, IsNotArmedWithoutACovarianceAndSaysSo) {
  flight.set_parameter("SIM_ODO_NAN", 1.0F);
  flight.run(10.0);
  EXPECT_FALSE(flight.autopilot.armed());
  EXPECT_THAT(why_not(), HasSubstr("it does not state how wrong its position is"));
  EXPECT_FALSE(flight.bridge.estimate());
  flight.set_parameter("SIM_ODO_NAN", 0.0F);
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
}

TEST_F(OdometryFlight, WhoseEstimatorDiesFliesItsSetpointsToTheirEndAndLands) {
  begin();
  flight.speaks = false;
  flight.each = [this, from = along(4.0).p, t0 = flight.now] {  // a plan that ends: 2 s of braking
    const double s = std::min((flight.now - t0).seconds(), 2.0);
    UavState setpoint;
    setpoint.at = flight.now;
    setpoint.motion.p = from + Vec3(2.0 * s - 0.5 * s * s, 0.0, 0.0);
    setpoint.motion.v.x() = 2.0 - s;
    if (flight.bridge.state()) flight.bridge.receive(setpoint);
  };
  const Vec3 end = along(4.0).p + Vec3(2.0, 0.0, 0.0);
  flight.set_parameter("SIM_ODO_OFF", 1.0F);
  flight.run(0.5);
  EXPECT_FALSE(flight.following());
  EXPECT_THAT(why_not(), HasSubstr("is its estimator alive?"));
  EXPECT_EQ(flight.bridge.status(flight.now).estimator, EstimatorHealth::Lost);
  flight.run(3.5);
  EXPECT_LT((flown() - end).norm(), 0.3) << "it ends where its plan ends";
  EXPECT_LT(flight.autopilot.model().truth().motion.v.norm(), 0.1);
  EXPECT_EQ(flight.bridge.stage(), Stage::Following);
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landing; }, 6.0));
  EXPECT_THAT(why_not(), HasSubstr("is its estimator alive?"));
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landed; }, 20.0));
}

TEST_F(OdometryFlight, IsNotFollowingWhileTheErrorIsTooLarge) {
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << why_not();
  flight.set_parameter("SIM_ODO_SIGMA", 1.0F);
  flight.run(0.2);
  EXPECT_THAT(why_not(), HasSubstr("above mavlink.odometry_max_sigma_m"));
  flight.set_parameter("SIM_ODO_SIGMA", 0.1F);
  flight.run(0.2);
  EXPECT_TRUE(flight.following()) << why_not();
}

/// A companion's estimator: it answers TIMESYNC by its own clock, and its frame is the autopilot's.
class CompanionsOdometry : public testing::Test {
 protected:
  static BridgeConfig config() {
    return {.start = Start::Arm, .set_parameters = true, .odometry = OdometrySource::Companion};
  }
  CompanionsOdometry() {
    flight.each = [this] { step(); };
  }
  std::uint64_t clock_us() const { return static_cast<std::uint64_t>((flight.now - kBoot).us); }
  void send(const auto& message) {
    flight.bridge.receive_companion(to_frame(message, {1, 197}, 0), flight.now,
                                    [](std::int64_t us) { return UTime{us - kUnix}; });
  }
  void step() {
    for (const Frame& frame : flight.bridge.take_companion_frames()) {
      const auto question = from_frame<Timesync>(frame);
      if (question && answers)
        send(Timesync{.tc1 = static_cast<std::int64_t>(clock_us()) * 1000, .ts1 = question->ts1});
    }
    if (!speaks || ++steps % 15 != 0) return;
    const UavState truth = flight.autopilot.model().estimate();
    Odometry m;
    m.time_usec = unix_times ? static_cast<std::uint64_t>(flight.now.us + kUnix) : clock_us();
    m.p = ned_of(truth.motion.p + apart);
    m.q = wxyz_of(swapped(Eigen::Quaterniond(Eigen::AngleAxisd(truth.yaw, Vec3::UnitZ()))));
    m.v = ned_of(truth.motion.v);
    m.frame_id = 20;
    m.child_frame_id = 20;
    for (const int k : {0, 6, 11, 15, 18, 20}) m.pose_covariance[idx(k)] = 0.01F;
    for (const int k : {0, 6, 11}) m.velocity_covariance[idx(k)] = 0.01F;
    m.estimator_type = 3;
    m.quality = 90;
    send(m);
  }
  std::string why_not() const { return flight.bridge.status(flight.now).why_not; }

  static constexpr UTime kBoot{900'000'000};
  static constexpr std::int64_t kUnix = 1'800'000'000'000'000;
  FlightInMemory flight{config()};
  bool answers = true, speaks = true, unix_times = false;
  Vec3 apart = Vec3::Zero();
  int steps = 0;
};

TEST_F(CompanionsOdometry, IsTernsWithItsOwnCovarianceAndClock) {
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << why_not();
  EXPECT_NEAR(flight.bridge.estimate()->pose_covariance[0], 0.01, 1e-6) << "nothing was left open";
  EXPECT_LT(flight.now - flight.bridge.estimate()->at, Duration{40'000});
  flight.run(1.0);
  speaks = false;
  flight.run(0.5);
  EXPECT_THAT(why_not(), HasSubstr("is its estimator alive?"));
}

TEST_F(CompanionsOdometry, MayHaveUnixTimesAndNoTimesync) {
  answers = false;
  unix_times = true;
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.estimate().has_value(); }, 5.0)) << why_not();
}

TEST_F(CompanionsOdometry, IsNotUsedWithAnUnknownClock) {
  answers = false;
  flight.run(8.0);
  EXPECT_THAT(why_not(), HasSubstr("TIMESYNC is not answered"));
  EXPECT_FALSE(flight.autopilot.armed());
}

TEST_F(CompanionsOdometry, ThatIsApartFromTheAutopilotsEstimateIsNotFlownBy) {
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); })) << why_not();
  apart = Vec3(1.5, 0.0, 0.0);
  flight.run(0.4);
  EXPECT_THAT(why_not(), HasSubstr("1.5 m beside"));
  EXPECT_TRUE(flight.run_until([&] { return flight.bridge.stage() == Stage::Landing; }, 2.0));
}

}  // namespace
}  // namespace tern::mavlink
