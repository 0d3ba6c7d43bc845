// Whole flights whose vehicle states its errors by MAVLink's ODOMETRY: margins, a reset, the end of the estimate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/flight_behind_mavlink.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

using ::testing::HasSubstr;
using namespace tern::mavlink;

/// A tuned PX4 among five movers that declare their motions.
class OdometryOverMavlink : public ::testing::Test {
 protected:
  OdometryOverMavlink()
      : system_(scenario_file("corridor_demo"),
                {"simulator.vehicle=external", "simulator.wait_s=180", "world.count=5", "semantics.enabled=false",
                 "simulator.wait_for=tern-mavlink, tern-executor, tern-predictor, tern-mapper, tern-planner",
                 "uav.flight_box={min: [-100, -20, 0], max: [200, 20, 8]}", "uav.limits.v_max=[4, 4, 1.5]",
                 "uav.dynamics={thrust_min: 4, thrust_max: 16, tilt_max: 38, body_rate_max: 170}"}),
        up_(std::make_shared<std::deque<Bytes>>()) {
    const BridgeConfig bridge{.start = Start::Arm,
                              .set_parameters = true,
                              .without_remote = true,
                              .odometry = OdometrySource::Autopilot,
                              .odometry_correlated = false};
    SimulatedAutopilotConfig autopilot;
    autopilot.tuned = true;
    const auto down = std::make_shared<std::deque<Bytes>>();
    node_ = &system_.runner().start("tern-mavlink", [&](Bus& bus) {
      return std::make_unique<MavlinkNode>(bus, std::make_unique<CableEnd>(down, up_), system_.scenario().uav, bridge,
                                           std::nullopt);
    });
    system_.runner().start("tern-autopilot-sim", [&](Bus& bus) {
      return std::make_unique<AutopilotSimNode>(bus, std::make_unique<CableEnd>(up_, down), autopilot, 1);
    });
    watch();
  }

  /// An armed vehicle would be landed by the node's destructor, which waits by the system's clock.
  void TearDown() override {
    (void)node_->end(system_.runner().now());
    until([&] { return node_->finished().has_value(); });
  }

  void watch() {
    Bus& bus = system_.runner().observer();
    bus.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) { status_ = status; });
    bus.subscribe(channels::kVehicleTruth, [this](const UavState& state) { truth_ = state; });
    bus.subscribe(channels::kUavState, [this](const UavState& state) { follow(state, state_, state_step_); });
    bus.subscribe(channels::kSetpoint, [this](const UavState& state) { follow(state, setpoint_, setpoint_step_); });
    bus.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& request) { tube_ = request.tube; });
    bus.subscribe(channels::kOdometry, [this](const tern::Odometry& odometry) { odometry_ = odometry; });
    bus.subscribe(channels::kPredictions, [this](const TrackSet& set) {
      alpha_ = 100.0;
      for (const Track& track : set.tracks) alpha_ = std::min(alpha_, track.alpha.front().x());
    });
    bus.subscribe(channels::kPoseError, [this](const PoseError& error) { apart_ = error.apart; });
    bus.subscribe(channels::kHeartbeat, [this](const tern::Heartbeat& beat) {
      if (beat.process == "tern-mavlink") said_ = beat.waiting_for;
    });
  }
  static void follow(const UavState& now, UavState& before, double& largest) {
    const double dt = (now.at - before.at).seconds();
    const Vec3 step = now.motion.p - before.motion.p - 0.5 * dt * (now.motion.v + before.motion.v);
    if (before.at.us > 0) largest = std::max(largest, step.norm());
    before = now;
  }
  bool until(const std::function<bool()>& condition, double seconds = 60.0) {
    system_.runner().run(system_.runner().now() + Duration::from_seconds(seconds), condition);
    return condition();
  }
  void fly(double seconds) { system_.runner().run(system_.runner().now() + Duration::from_seconds(seconds)); }
  void fly_midway() {
    ASSERT_TRUE(until([&] { return status_.following && state_.motion.p.x() > 8.0; })) << status_.why_not;
  }
  void set(const std::string& name, float value) {
    up_->push_back(to_bytes(
        to_frame(ParamSet{.param_value = value, .target_system = 1, .param_id = text_of<16>(name), .param_type = 9},
                 {255, 190}, 0)));
  }

  VirtualSystem system_;
  CableEnd::Queue up_;
  Node* node_ = nullptr;
  VehicleStatus status_;
  UavState truth_, state_, setpoint_;
  tern::Odometry odometry_;
  Vec3 tube_ = Vec3::Zero();
  double state_step_ = 0.0, setpoint_step_ = 0.0;
  double alpha_ = 0.0;  ///< the least one: that of the nearest mover, since α grows with the distance
  double apart_ = 0.0;  ///< PoseError::apart, m
  std::string said_;
};

TEST_F(OdometryOverMavlink, AGrowingErrorWidensTracksThatAreKnownInWAndNotTheTube) {
  fly_midway();
  EXPECT_LT(alpha_, 0.7);
  const Vec3 tube = tube_;
  set("SIM_ODO_GROW", 0.1F);
  fly(3.0);
  EXPECT_NEAR(std::sqrt(odometry_.pose_covariance[0]), 0.33, 0.02);
  EXPECT_GT(alpha_, 3.368 * 0.32);
  EXPECT_LT(tube_.maxCoeff(), tube.maxCoeff() + 0.1) << "what the vehicle sees, it sees relative to itself";
  EXPECT_TRUE(status_.following) << status_.why_not;
}

TEST_F(OdometryOverMavlink, AResetMovesTheCommittedTrajectoryByNoStep) {
  fly_midway();
  state_step_ = setpoint_step_ = 0.0;
  const Vec3 error = state_.motion.p - truth_.motion.p, tube = tube_;
  EXPECT_LT(apart_, 0.1);
  set("SIM_EST_JUMP", 0.5F);
  fly(1.0);
  EXPECT_EQ(odometry_.epoch, 1);
  EXPECT_EQ(status_.resets, 0);
  EXPECT_LT(setpoint_step_, 0.005);
  EXPECT_LT(state_step_, 0.03);
  EXPECT_LT((state_.motion.p - truth_.motion.p - error).norm(), 0.2) << "0.1 m, and the age of the two";
  const OdometryOffset T_WO{odometry_.p_WO, odometry_.yaw_WO, odometry_.epoch};
  EXPECT_NEAR((T_WO.to_W(PointInO{odometry_.p_OB}).xyz - truth_.motion.p - error).norm(), 0.5, 0.15) << "in W at once";
  EXPECT_LT(tube_.maxCoeff(), tube.maxCoeff() + 0.2);
  EXPECT_GT(apart_, 0.3) << "what is still to come is in the margin";
  fly(5.0);
  EXPECT_NEAR((state_.motion.p - truth_.motion.p - error).norm(), 0.5, 0.15);
  EXPECT_TRUE(status_.following) << status_.why_not;
  EXPECT_LT(setpoint_step_, 0.005);
}

TEST_F(OdometryOverMavlink, ItsEndIsTheEndOfTheCommittedTrajectoryAndALanding) {
  fly_midway();
  set("SIM_ODO_OFF", 1.0F);
  fly(0.6);
  EXPECT_FALSE(status_.following);
  EXPECT_THAT(status_.why_not, HasSubstr("ODOMETRY is"));
  EXPECT_EQ(status_.estimator, EstimatorHealth::Lost);
  const Vec3 end = system_.executor().executor()->sample(system_.runner().now() + Duration{20'000'000}).p;
  ASSERT_TRUE(until([&] { return truth_.motion.v.norm() < 0.05; }, 10.0));
  EXPECT_THAT(said_, HasSubstr("is its estimator alive?"));
  EXPECT_TRUE(system_.executor().executor()->at_rest(system_.runner().now() + Duration{1'000'000}));
  fly(1.0);
  EXPECT_LT((state_.motion.p - end).norm(), 0.2) << "where the committed trajectory ends";
  EXPECT_TRUE(until([&] { return status_.landed && !status_.armed; }, 30.0)) << status_.why_not;
}

TEST_F(OdometryOverMavlink, WithoutACovarianceItDoesNotStart) {
  set("SIM_ODO_NAN", 1.0F);
  fly(10.0);
  EXPECT_FALSE(status_.armed);
  EXPECT_THAT(said_, HasSubstr("it does not state how wrong its position is (pose_covariance is nan)"));
}

}  // namespace
}  // namespace tern::testing
