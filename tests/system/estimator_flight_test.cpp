// tern-estimator in closed loop: the vehicle flies on its estimate, and the truth judges it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/virtual_system.h"
#include "core/world/body.h"
#include "core/world/inertial.h"
#include "messages/channels.h"
#include "planner/planning_world.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/effort.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

struct Judged {
  FlightResult result;
  std::int64_t instants = 0, covered = 0;
  double end_nees = 0.0;  ///< of the position, 3 degrees of freedom
  double end_error = 0.0, end_sigma = 0.0, largest_error = 0.0, largest_sigma = 0.0;
  std::int64_t epochs = 0;
};

/// Flies a scenario on the estimate.
class EstimatedFlightJudge {
 public:
  EstimatedFlightJudge(const std::string& scenario, int seed, const std::string& setting = "semantics.enabled=false")
      : system_(scenario_file(scenario), {"simulator.estimation=vio", setting, "seed=" + std::to_string(seed)}) {
    Bus& bus = system_.runner().observer();
    bus.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) {
      if (!map_ && maps_.add(chunk).value_or(false)) map_ = maps_.take();
    });
    bus.subscribe(channels::kVehicleTruth, [this](const UavState& truth) { truth_.push_back(truth); });
    bus.subscribe(channels::kOdometry, [this](const Odometry& odometry) { odometry_.push_back(odometry); });
  }

  Judged fly() {
    system_.runner().run(system_.runner().now() + Duration{90'000'000},
                         [this] { return system_.simulator().result().has_value(); });
    Judged out;
    out.result = system_.simulator().result().value_or(FlightResult{});
    for (const Odometry& now : odometry_) {
      if (now.state != EstimatorState::Tracking && now.state != EstimatorState::Blind) continue;
      judge(now, out);
    }
    return out;
  }

  /// The error that the labels of the flight's map foretell for the way that its planner chooses.
  ForetoldError foretold() const {
    const UavSpec& uav = system_.scenario().uav;
    PlannerConfig config;
    config.error_price.error_price = kPrice;
    const auto map = std::make_shared<const MapProducts>(map_.value(), config);
    const GoalFieldKey key{uav.goal, map->version, 0, body_box(uav.body), uav.flight_box, way_speed(*map, uav.limits)};
    return foretell_error(make_goal_field(key, map, {}, uav.start), uav.start, key.speed).value();
  }
  /// Metres flown in truth.
  double way() const {
    double metres = 0.0;
    for (std::size_t k = 1; k < truth_.size(); ++k) metres += (truth_[k].motion.p - truth_[k - 1].motion.p).norm();
    return metres;
  }
  static constexpr double kPrice = 20.0;

 private:
  void judge(const Odometry& odometry, Judged& out) const {
    const auto after =
        std::find_if(truth_.begin(), truth_.end(), [&](const UavState& truth) { return truth.at >= odometry.at; });
    if (after == truth_.end()) return;
    const double dt = (odometry.at - after->at).seconds();
    const Vec3 truth = after->motion.p + dt * after->motion.v + 0.5 * dt * dt * after->motion.a;
    const Vec3 place = OdometryOffset{odometry.p_WO, odometry.yaw_WO, odometry.epoch}.to_W(PointInO{odometry.p_OB}).xyz;
    Eigen::Matrix3d P;
    for (int k = 0; k < 9; ++k) P(k / 3, k % 3) = odometry.pose_covariance[idx(6 * (k / 3) + k % 3)];
    const Vec3 error = truth - place;
    out.end_nees = error.dot(P.ldlt().solve(error));
    out.end_error = error.norm();
    out.end_sigma = std::sqrt(P.trace());
    out.largest_error = std::max(out.largest_error, out.end_error);
    out.largest_sigma = std::max(out.largest_sigma, out.end_sigma);
    out.epochs = odometry.epoch;
    ++out.instants;
    out.covered += out.end_nees < 11.345 ? 1 : 0;
  }

  VirtualSystem system_;
  std::vector<UavState> truth_;
  std::vector<Odometry> odometry_;
  MapAssembler maps_;
  std::optional<VoxelMap> map_;
};

TEST(EstimatorFlight, AcrossALakeErrorsAreWhatTheCovarianceSays) {
  const int flights = std::max(2, support::at_effort(20));
  Judged all;
  double squares = 0.0, variances = 0.0;
  for (int seed = 1; seed <= flights; ++seed) {
    const Judged flight = EstimatedFlightJudge("lake", seed).fly();
    std::printf("seed %d: end %.3f m (stated %.3f), largest %.3f m (%.3f), epochs %d, %s\n", seed, flight.end_error,
                flight.end_sigma, flight.largest_error, flight.largest_sigma, static_cast<int>(flight.epochs),
                flight.result.detail.c_str());
    EXPECT_EQ(flight.result.contacts_moving + flight.result.contacts_at_rest, 0);
    EXPECT_GT(flight.largest_sigma, 0.3);  // there is nothing to see above the water
    all.instants += flight.instants;
    all.covered += flight.covered;
    all.end_nees += flight.end_nees;
    squares += flight.end_error * flight.end_error;
    variances += flight.end_sigma * flight.end_sigma;
  }
  const double coverage = static_cast<double>(all.covered) / static_cast<double>(all.instants);
  std::printf("end %.3f m rms, stated %.3f m; inside the 99 %% bound %.4f; NEES %.2f of %d\n",
              std::sqrt(squares / flights), std::sqrt(variances / flights), coverage, all.end_nees, 3 * flights);
  EXPECT_GT(coverage, 0.95);
  // χ² with 3 degrees of freedom per flight: more than this has a probability of 0.1 % (Wilson and Hilferty).
  const double n = 3.0 * flights;
  EXPECT_LT(all.end_nees, n * std::pow(1.0 - 2.0 / (9.0 * n) + 3.09 * std::sqrt(2.0 / (9.0 * n)), 3));
}

TEST(EstimatorFlight, BeginsInGustyWind) {
  EstimatedFlightJudge judge("lake", 1, "simulator.wind={speed: 8, towards: 1.57}");
  const Judged flight = judge.fly();
  EXPECT_EQ(flight.result.contacts_moving + flight.result.contacts_at_rest, 0);
  EXPECT_GT(judge.way(), 70.0) << flight.result.detail;
  EXPECT_LT(flight.end_nees, 16.27);  // χ² with 3 degrees of freedom: more has a probability of 0.1 %
}

TEST(EstimatorFlight, WithATagInViewOfTheGoalArrivesInTruth) {
  const Judged flight =
      EstimatedFlightJudge("lake", 1, "simulator.vio.tags=[{position: [79, 0, 1.5], range_m: 12}]").fly();
  EXPECT_EQ(flight.result.outcome, FlightOutcome::Reached) << flight.result.detail;
  EXPECT_GT(flight.largest_error, 0.2) << "without the tag it would miss its goal";
  EXPECT_LT(flight.end_error, 0.1);
}

/// The error stays within its stated bound, and the vehicle does not stop to wait for light.
TEST(EstimatorFlight, FliesOnWhileTheCameraIsDark) {
  EstimatedFlightJudge judge("lake", 1, "simulator.vio.dark=[{from_s: 5, to_s: 10}]");
  const Judged flight = judge.fly();
  EXPECT_EQ(flight.result.contacts_moving + flight.result.contacts_at_rest, 0);
  EXPECT_GT(judge.way(), 70.0) << flight.result.detail;
  EXPECT_LT(flight.result.flight_time_s, 23.0) << "without darkness it takes 19.8 s; to wait would take 5 s more";
  EXPECT_EQ(flight.covered, flight.instants);
}

TEST(EstimatorFlight, OfAPricedWayEndsWithTheErrorThatLabelsForetold) {
  EstimatedFlightJudge judge("lake", 1, "planner.semantics.error_price=20");
  const Judged flight = judge.fly();
  const ForetoldError foretold = judge.foretold();
  std::printf("way %.1f m; σ at the goal %.3f m (foretold %.3f), largest %.3f m (%.3f), %s\n", judge.way(),
              flight.end_sigma, foretold.at_goal, flight.largest_sigma, foretold.at_worst,
              flight.result.detail.c_str());
  EXPECT_LT(judge.way(), 1.10 * 75.0);
  EXPECT_LT(flight.largest_sigma, 0.45) << "low across the lake it is 0.5 m and more";
  EXPECT_LT(std::abs(std::log(flight.end_sigma / foretold.at_goal)), std::log(1.5));
}

}  // namespace
}  // namespace tern::testing
