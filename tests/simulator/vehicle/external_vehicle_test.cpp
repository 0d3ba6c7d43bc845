// The measures of a vehicle that others fly: its states have time stamps that jitter.
#include "simulator/vehicle/external_vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "simulator/referee/referee.h"

namespace tern {
namespace {

constexpr UTime kZero{1'000'000};

/// A flight of 15 m along x: 0.5 s at rest, then with a smooth start and end at up to 2 m/s.
UavState state_at(double t_s) {
  constexpr double kBegin = 0.5, kRamp = 2.0, kCruise = 5.5, kTop = 2.0;
  const double t = std::clamp(t_s - kBegin, 0.0, 2.0 * kRamp + kCruise);
  UavState state;
  const auto ramp = [](double x) { return kTop * (x / 2.0 - kRamp / (2.0 * M_PI) * std::sin(M_PI * x / kRamp)); };
  const double full = ramp(kRamp);
  if (t < kRamp) {
    state.motion.p.x() = ramp(t);
    state.motion.v.x() = kTop * 0.5 * (1.0 - std::cos(M_PI * t / kRamp));
  } else if (t < kRamp + kCruise) {
    state.motion.p.x() = full + kTop * (t - kRamp);
    state.motion.v.x() = kTop;
  } else {
    const double left = 2.0 * kRamp + kCruise - t;
    state.motion.p.x() = 2.0 * full + kTop * kCruise - ramp(left);
    state.motion.v.x() = kTop * 0.5 * (1.0 - std::cos(M_PI * left / kRamp));
  }
  state.motion.p.z() = 1.0;
  return state;
}

/// Flies with states at 100 Hz whose time stamps are off by up to `jitter_s`, and returns the referee's result.
FlightResult fly(double jitter_s, unsigned seed) {
  Scenario scenario;
  scenario.uav.start = state_at(0.0).motion.p;
  scenario.uav.goal = state_at(20.0).motion.p;
  ExternalVehicle vehicle(scenario.uav, kZero);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-jitter_s, jitter_s);
  Referee referee(scenario, make_world(scenario, "").value(), vehicle.judged_limits());
  referee.trust_stated_velocities();
  for (int k = 0; k < 1200 && !referee.verdict(); ++k) {
    UavState state = state_at(0.01 * k);
    state.at = kZero + Duration::from_seconds(0.01 * k + (k == 0 ? 0.0 : jitter(random)));
    vehicle.receive_truth(state);
    const UTime from = kZero + referee.now(), to = vehicle.truth().end();
    if (to <= from) continue;
    for (const CubicPiece& piece : vehicle.truth().pieces(from, to).pieces) referee.advance(referee.now(), piece);
  }
  return referee.result_so_far();
}

TEST(ExternalVehicle, SpeedStopsAndPathAreThoseOfItsOwnVelocitiesHoweverItsTimeStampsJitter) {
  for (const double jitter_s : {0.0, 0.004, 0.009}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const FlightResult result = fly(jitter_s, seed);
      EXPECT_EQ(result.outcome, FlightOutcome::Reached) << result.detail;
      EXPECT_NEAR(result.top_speed_mps, 2.0, 1e-9) << "jitter " << jitter_s << ", seed " << seed;
      EXPECT_EQ(result.stops, 0) << "jitter " << jitter_s << ", seed " << seed;
      EXPECT_NEAR(result.path_length_m, 15.0, 0.15) << "jitter " << jitter_s << ", seed " << seed;
    }
  }
}

TEST(ExternalVehicle, StatesOfNearlyOneTimeAreOne) {
  ExternalVehicle vehicle(UavSpec{}, kZero);
  UavState state = state_at(0.0);
  state.at = kZero;
  vehicle.receive_truth(state);
  state.at = kZero + Duration{2'000};
  state.motion.p.x() += 0.02;
  vehicle.receive_truth(state);
  EXPECT_EQ(vehicle.truth().end(), kZero);
  state.at = kZero + Duration{10'000};
  vehicle.receive_truth(state);
  EXPECT_EQ(vehicle.truth().end(), state.at);
}

TEST(ExternalVehicle, AJumpThatNoVehicleCanFlyTouchesNothingOnItsWay) {
  Scenario scenario;
  scenario.uav.start = Vec3(0, 0, 1);
  ExternalVehicle vehicle(scenario.uav, kZero);
  UavState state;
  state.motion.p = Vec3(0, 0, 1);
  state.motion.v = Vec3(2, 0, 0);
  state.at = kZero + Duration{10'000};
  vehicle.receive_estimate(state);
  state.motion.p = Vec3(4, 0, 1);  // the same clock, another place
  state.at = kZero + Duration{20'000};
  vehicle.receive_estimate(state);
  EXPECT_EQ(vehicle.truth().sample(kZero + Duration{15'000}).p, Vec3(0, 0, 1));
  state.motion.p = Vec3(4.02, 0, 1);
  state.at = kZero + Duration{30'000};
  vehicle.receive_estimate(state);
  EXPECT_NEAR(vehicle.truth().sample(kZero + Duration{25'000}).p.x(), 4.01, 1e-9);
}

}  // namespace
}  // namespace tern
