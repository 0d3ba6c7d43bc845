// Flights on an estimate, which a test makes as wrong as it wants.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "campaign/virtual_system.h"
#include "core/world/stated_bound.h"
#include "executor/app/executor_node.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/oracle_estimator.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

/// A quadrotor in an empty world. `offset` of T_WO is only changed where a test says so.
class EstimatedFlight : public ::testing::Test {
 protected:
  static std::vector<std::string> overrides() {
    return {"simulator.estimation=vio",
            "simulator.vio.imu.force_noise=0",
            "simulator.vio.imu.force_walk=0",
            "simulator.vio.imu.rate_noise=0",
            "simulator.vio.imu.rate_walk=0",
            "simulator.vio.imu.force_bias=0",
            "simulator.vio.imu.rate_bias=0",
            "uav.goal=[30, 0, 1]",
            "semantics.enabled=false",
            "simulator.vio.max_sigma_m=0.5",
            "timeout_s=20"};
  }
  explicit EstimatedFlight(const std::vector<std::string>& more = {}) : system_(scenario_file("lake"), joined(more)) {
    system_.stop("tern-estimator");
    system_.runner().start("tern-estimator", [this](Bus& bus) {
      return std::make_unique<OracleEstimator>(bus, system_.scenario().uav.start, errors_);
    });
    Bus& bus = system_.runner().observer();
    bus.subscribe(channels::kUavState, [this](const UavState& state) { on_state(state); });
    bus.subscribe(channels::kVehicleTruth, [this](const UavState& state) { truth_ = state; });
    bus.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) { status_ = status; });
  }
  static std::vector<std::string> joined(const std::vector<std::string>& more) {
    std::vector<std::string> all = overrides();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void on_state(const UavState& state) {
    if (state_.at.us > 0) {
      const Vec3 moved = state.motion.p - state_.motion.p;
      const double dt = (state.at - state_.at).seconds();
      largest_step_ = std::max(largest_step_, (moved - dt * state.motion.v).norm());
    }
    state_ = state;
  }
  void fly(double seconds) { system_.runner().run(system_.runner().now() + Duration::from_seconds(seconds)); }
  void fly_midway() {
    system_.runner().run(system_.runner().now() + Duration::from_seconds(30.0),
                         [this] { return truth_.motion.p.x() > 10.0; });
    ASSERT_GT(truth_.motion.v.x(), 2.0);
  }
  FlightResult fly_to_the_end() {
    system_.runner().run(system_.runner().now() + Duration::from_seconds(60.0),
                         [this] { return system_.simulator().result().has_value(); });
    EXPECT_TRUE(system_.simulator().result());
    return system_.simulator().result().value_or(FlightResult{});
  }

  VirtualSystem system_;
  OracleErrors errors_;
  UavState state_, truth_;
  VehicleStatus status_;
  double largest_step_ = 0.0;
};

TEST_F(EstimatedFlight, OfATrueEstimateArrives) {
  const FlightResult result = fly_to_the_end();
  EXPECT_EQ(result.outcome, FlightOutcome::Reached) << result.detail;
  EXPECT_LT((state_.motion.p - truth_.motion.p).norm(), 0.02);
  EXPECT_EQ(system_.executor().tube_exits(), 0);
}

TEST_F(EstimatedFlight, GoesWhereTheVehicleBelievesTheGoalToBe) {
  fly_midway();
  for (int k = 0; k < 40; ++k) {  // 0.4 m in 4 s
    errors_.drift += Vec3(0.0, 0.01, 0.0);
    fly(0.1);
  }
  const FlightResult result = fly_to_the_end();
  EXPECT_EQ(result.outcome, FlightOutcome::Timeout);
  EXPECT_TRUE(result.detail.starts_with(kReachedAsBelieved)) << result.detail;
  EXPECT_LT((state_.motion.p - Vec3(30, 0, 1)).norm(), 0.1);
  EXPECT_NEAR((truth_.motion.p - Vec3(30, 0, 1)).norm(), 0.4, 0.1);
}

TEST_F(EstimatedFlight, IsReachedAsBelievedAlthoughTheEstimateIsCorrectedAllTheTime) {
  fly_midway();
  errors_.sigma = 0.3;
  const UTime last = system_.runner().now() + Duration::from_seconds(15.0);
  double y = 0.3;
  while (!system_.simulator().result() && system_.runner().now() < last) {
    y = y > 0.5 ? 0.3 : 0.6;
    errors_.drift = errors_.offset = Vec3(0.0, y, 0.0);  // O stays, T_WO moves by 0.3 m, at 0.1 m/s
    fly(2.0);
  }
  ASSERT_TRUE(system_.simulator().result());
  const FlightResult result = *system_.simulator().result();
  EXPECT_EQ(result.outcome, FlightOutcome::Timeout) << "the verdict is about the truth";
  EXPECT_TRUE(result.detail.starts_with(kReachedAsBelieved)) << result.detail;
  EXPECT_NE(result.detail.find("the stated 99 % bound is 1.01 m"), std::string::npos) << result.detail;
}

TEST_F(EstimatedFlight, WithoutOdometryComesToRestAndSaysSo) {
  fly_midway();
  errors_.is_silent = true;
  fly(5.0);
  EXPECT_FALSE(status_.following);
  EXPECT_NE(status_.why_not.find("ODOMETRY"), std::string::npos) << status_.why_not;
  EXPECT_EQ(status_.estimator, EstimatorHealth::Lost);
  EXPECT_TRUE(system_.executor().executor()->at_rest(system_.runner().now()));
  EXPECT_LT(truth_.motion.v.norm(), 0.05);
  EXPECT_LT(truth_.motion.p.x(), 25.0);
  errors_.is_silent = false;
  EXPECT_EQ(fly_to_the_end().outcome, FlightOutcome::Reached);
}

TEST_F(EstimatedFlight, ThatKnowsTooLittleComesToRestUntilItKnowsMore) {
  fly_midway();
  errors_.sigma = 0.6;
  fly(5.0);
  EXPECT_FALSE(status_.following);
  EXPECT_NE(status_.why_not.find("simulator.vio.max_sigma_m"), std::string::npos) << status_.why_not;
  EXPECT_LT(truth_.motion.v.norm(), 0.05);
  errors_.sigma = 0.1;
  EXPECT_EQ(fly_to_the_end().outcome, FlightOutcome::Reached);
}

TEST_F(EstimatedFlight, WhoseOffsetIsCorrectedNeitherStepsNorLeavesItsTube) {
  errors_.offset = Vec3(0.0, -0.4, 0.0);
  errors_.drift = Vec3::Zero();
  fly_midway();
  const Vec3 before = state_.motion.p - truth_.motion.p;
  EXPECT_LT(before.norm(), 0.02);
  errors_.offset = Vec3::Zero();
  errors_.drift = Vec3(0.0, 0.4, 0.0);  // O stays, T_WO moves by 0.4 m
  largest_step_ = 0.0;
  fly(1.0);
  EXPECT_NEAR((state_.motion.p - truth_.motion.p).y(), 0.1, 0.03) << "the correction is being followed";
  (void)fly_to_the_end();
  EXPECT_LT(largest_step_, 0.01);
  EXPECT_EQ(system_.executor().tube_exits(), 0);
  EXPECT_NEAR((state_.motion.p - truth_.motion.p).y(), 0.4, 0.03);
}

/// Two pillars leave a gap on the straight way. An estimate with a standard deviation of 0.25 m must not use it: its
/// margin is 0.85 m on each side.
class GapFlight : public EstimatedFlight {
 protected:
  using EstimatedFlight::EstimatedFlight;
  double y_at_gap() {
    double y = 1e9;
    system_.runner().run(system_.runner().now() + Duration::from_seconds(40.0), [&] {
      if (truth_.motion.p.x() > 20.0 && y > 1e8) y = truth_.motion.p.y();
      return system_.simulator().result().has_value();
    });
    return y;
  }
};

/// The owner of the pillars declares them.
class DeclaredGap : public GapFlight {
 protected:
  DeclaredGap()
      : GapFlight({"world.obstacles=[{centre: [20, 1.1, 2], half_extents: [0.2, 0.5, 2]}, {centre: [20, -1.1, 2], "
                   "half_extents: [0.2, 0.5, 2]}]"}) {}
};

TEST_F(DeclaredGap, IsUsedByAVehicleThatKnowsWhereItIs) { EXPECT_LT(std::abs(y_at_gap()), 0.6); }

TEST_F(DeclaredGap, IsFlownAroundByOneThatDoesNot) {
  errors_.sigma = 0.25;
  const double y = y_at_gap();
  EXPECT_GT(std::abs(y), 1.6 + 0.85);
  EXPECT_EQ(system_.simulator().result()->outcome, FlightOutcome::Reached);
}

/// The pillars are voxels of the map.
class MappedGap : public GapFlight {
 protected:
  MappedGap()
      : GapFlight({"semantics.enabled=true", "semantics.classes={wall: occupied}",
                   "semantics.regions=[{name: left, class: wall, box: {min: [19.75, 0.75, 0], max: [20.25, 1.75, 4]}}, "
                   "{name: right, class: wall, box: {min: [19.75, -1.75, 0], max: [20.25, -0.75, 4]}}]"}) {}
};

TEST_F(MappedGap, IsUsedByAVehicleThatKnowsWhereItIs) { EXPECT_LT(std::abs(y_at_gap()), 0.75); }

TEST_F(MappedGap, IsFlownAroundByOneThatDoesNot) {
  errors_.sigma = 0.25;
  const double y = y_at_gap();
  EXPECT_GT(std::abs(y), 1.75 + 0.85);
  EXPECT_EQ(system_.simulator().result()->outcome, FlightOutcome::Reached);
}

}  // namespace
}  // namespace tern::testing
