#include "simulator/inertial/imu.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/world/vehicle.h"

namespace tern {
namespace {

constexpr double kStep = 5e-3;
const InertialSample kAtRest{Vec3::Zero(), Vec3(0.0, 0.0, kGravity)};

TEST(SimulatedImu, WhiteNoiseHasTheDensityOfTheSpec) {
  ImuSpec spec;
  spec.force_walk = spec.rate_walk = spec.force_bias = spec.rate_bias = 0.0;
  SimulatedImu imu(spec, 1);
  constexpr int kSamples = 20'000;
  InertialSample mean{Vec3::Zero(), Vec3::Zero()}, square = mean;
  for (int k = 0; k < kSamples; ++k) {
    const InertialSample noise = imu.measure(kAtRest, kStep);
    mean.rate += noise.rate / kSamples;
    mean.force += (noise.force - kAtRest.force) / kSamples;
    square.rate += noise.rate.cwiseAbs2() / kSamples;
    square.force += (noise.force - kAtRest.force).cwiseAbs2() / kSamples;
  }
  // The standard deviation of n samples has a relative error of 1/√(2n) = 0.5 %; 2.5 % are five of them.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(square.rate[axis] * kStep) / spec.rate_noise, 1.0, 0.025);
    EXPECT_NEAR(std::sqrt(square.force[axis] * kStep) / spec.force_noise, 1.0, 0.025);
    EXPECT_LT(std::abs(mean.force[axis]), 5.0 * spec.force_noise / std::sqrt(kStep * kSamples));
  }
}

/// The velocity error of dead reckoning at rest grows as a_n √t by noise, and a_w √(t³/3) by the walk.
TEST(SimulatedImu, DeadReckoningGrowsByTheClosedForm) {
  ImuSpec spec;
  spec.force_bias = spec.rate_bias = spec.rate_noise = spec.rate_walk = 0.0;
  spec.force_walk = 0.05;
  constexpr int kFlights = 400, kSamples = 1000;
  double velocity = 0.0, position = 0.0;
  for (int flight = 0; flight < kFlights; ++flight) {
    SimulatedImu imu(spec, 100 + static_cast<std::uint64_t>(flight));
    InertialState state;
    for (int k = 0; k < kSamples; ++k) state = strapdown(state, imu.measure(kAtRest, kStep), kStep);
    velocity += state.v.squaredNorm() / (3.0 * kFlights);
    position += state.p.squaredNorm() / (3.0 * kFlights);
  }
  const double t = kStep * kSamples, n2 = spec.force_noise * spec.force_noise, w2 = spec.force_walk * spec.force_walk;
  // 1200 axes: the variance has a relative error of √(2/1200) = 4 %; 20 % are five of them.
  EXPECT_NEAR(velocity / (n2 * t + w2 * t * t * t / 3.0), 1.0, 0.2);
  EXPECT_NEAR(position / (n2 * std::pow(t, 3) / 3.0 + w2 * std::pow(t, 5) / 20.0), 1.0, 0.2);
}

TEST(SimulatedImu, TheSeedDecidesEverything) {
  SimulatedImu a({}, 7), b({}, 7), c({}, 8);
  EXPECT_EQ(a.bias().force, b.bias().force);
  EXPECT_NE(a.bias().force, c.bias().force);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(a.measure(kAtRest, kStep).rate, b.measure(kAtRest, kStep).rate);
}

}  // namespace
}  // namespace tern
