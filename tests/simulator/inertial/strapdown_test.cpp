#include "simulator/inertial/strapdown.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/world/vehicle.h"

namespace tern {
namespace {

Vec3 drawn(Rng& rng, double size) {
  const double x = rng.uniform(-size, size), y = rng.uniform(-size, size), z = rng.uniform(-size, size);
  return {x, y, z};
}

InertialState drawn_state(Rng& rng) { return {rotation_exp(drawn(rng, 1.5)), drawn(rng, 50.0), drawn(rng, 10.0)}; }

TEST(Strapdown, ExpAndLogAreInverse) {
  Rng rng(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 phi = drawn(rng, k % 3 == 0 ? 1e-6 : 1.7);
    const Mat3 R = rotation_exp(phi);
    EXPECT_LT((rotation_log(R) - phi).norm(), 1e-9) << phi.transpose();
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-13);
  }
}

TEST(Strapdown, IsTheIntegralOfConstantRateAndForce) {
  Rng rng(2);
  for (const double size : {0.01, 3.0, 40.0}) {
    const InertialState from = drawn_state(rng);
    const InertialSample sample{drawn(rng, size), drawn(rng, 30.0)};
    constexpr int kSteps = 200'000;
    constexpr double kTime = 0.1, kStep = kTime / kSteps;
    InertialState slow = from;
    for (int k = 0; k < kSteps; ++k) {  // midpoint rule
      const Mat3 half = slow.R * rotation_exp(sample.rate * kStep / 2.0);
      const Vec3 a = half * sample.force - Vec3(0.0, 0.0, kGravity);
      slow.p += kStep * slow.v + 0.5 * kStep * kStep * a;
      slow.v += kStep * a;
      slow.R = slow.R * rotation_exp(sample.rate * kStep);
    }
    const InertialState exact = strapdown(from, sample, kTime);
    EXPECT_LT((exact.p - slow.p).norm(), 1e-8) << size;
    EXPECT_LT((exact.v - slow.v).norm(), 1e-7) << size;
    EXPECT_LT((exact.R - slow.R).norm(), 1e-8) << size;
  }
}

TEST(Strapdown, SeriesMeetTheClosedFormsAtTheirEdge) {
  for (const double theta : {0.99e-2, 1.01e-2}) {
    const InertialState state;
    const InertialSample sample{Vec3(theta, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)};
    const InertialState to = strapdown(state, sample, 1.0);
    EXPECT_NEAR(to.v.y(), std::sin(theta) / theta, 1e-15);
    EXPECT_NEAR(to.v.z() + kGravity, theta / 2.0 - theta * theta * theta / 24.0, 1e-11);
    EXPECT_NEAR(to.p.y(), (1.0 - std::cos(theta)) / (theta * theta), 1e-11);
  }
}

TEST(Strapdown, SampleBetweenGivesAttitudeAndVelocityBack) {
  Rng rng(3);
  for (int k = 0; k < 1000; ++k) {
    const InertialState from = drawn_state(rng);
    InertialState to = from;
    to.R = from.R * rotation_exp(drawn(rng, 0.2));
    to.v += drawn(rng, 0.2);
    const InertialState back = strapdown(from, sample_between(from, to, 5e-3), 5e-3);
    EXPECT_LT((back.R - to.R).norm(), 1e-12);
    EXPECT_LT((back.v - to.v).norm(), 1e-12);
  }
}

/// A banked circle of 5 m/s, sampled by its ends only: no drift from sampling after 20 s.
TEST(Strapdown, AFlownCircleIsReproducedBySamples) {
  const double radius = 4.0, omega = 1.25, step = 5e-3;
  const auto at = [=](double t) {
    InertialState s;
    const double c = std::cos(omega * t), n = std::sin(omega * t);
    s.p = radius * Vec3(c, n, 0.0);
    s.v = radius * omega * Vec3(-n, c, 0.0);
    const Vec3 f = -radius * omega * omega * Vec3(c, n, 0.0) + Vec3(0.0, 0.0, kGravity);
    const Vec3 z = f.normalized(), y = z.cross(s.v).normalized();
    s.R.col(0) = y.cross(z);
    s.R.col(1) = y;
    s.R.col(2) = z;
    return s;
  };
  InertialState flown = at(0.0);
  for (int k = 0; k < 4000; ++k) {
    flown = strapdown(flown, sample_between(at(step * k), at(step * (k + 1)), step), step);
  }
  EXPECT_LT((flown.R - at(20.0).R).norm(), 1e-10);
  EXPECT_LT((flown.v - at(20.0).v).norm(), 1e-10);
  EXPECT_LT((flown.p - at(20.0).p).norm(), 1e-3);
}

}  // namespace
}  // namespace tern
