#include "simulator/vehicle/quadrotor_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tern {
namespace {

constexpr double kNoGround = -std::numeric_limits<double>::infinity();

QuadrotorConfig config_of(QuadrotorClass kind) {
  QuadrotorConfig config;
  config.kind = kind;
  config.body = quadrotor_spec(kind);
  config.controller = QuadrotorConfig::controller_for(kind, config.body);
  return config;
}

UTime at_s(double t) { return UTime{} + Duration::from_seconds(t); }

/// Along x at `speed`, back and forth in y with a peak of `sideways` m/s², both with a smooth beginning.
struct Slalom {
  double speed, sideways;

  [[nodiscard]] UavState at(double t) const {
    const double omega = sideways / (0.8 * speed);  // the path's lateral speed is 0.8 of the forward one
    UavState state;
    state.at = at_s(t);
    // x = s(t), y = A u(t) sin(ω t) with u a smooth step of 4 s, differentiated numerically.
    constexpr double kH = 1e-3;
    const Vec3 a = place(t - 2 * kH, omega), b = place(t - kH, omega), c = place(t, omega), d = place(t + kH, omega),
               e = place(t + 2 * kH, omega);
    state.motion.p = c;
    state.motion.v = (a - 8 * b + 8 * d - e) / (12 * kH);
    state.motion.a = (b - 2 * c + d) / (kH * kH);
    state.motion.j = (e - 2 * d + 2 * b - a) / (2 * kH * kH * kH);
    return state;
  }

 private:
  [[nodiscard]] Vec3 place(double t, double omega) const {
    const double u = std::clamp(t / 4.0, 0.0, 1.0), smooth = u * u * u * (10 - 15 * u + 6 * u * u);
    const double x = t < 0 ? 0 : t < 4.0 ? speed * 4.0 * u * u * u * (1.0 - 0.5 * u) : speed * (t - 2.0);
    return {x, sideways / (omega * omega) * smooth * std::sin(omega * t), 5.0};
  }
};

struct Tracking {
  double rmse = 0.0, largest = 0.0;
};

Tracking track(const QuadrotorConfig& config, const WindSpec& wind, const EstimatorSpec& estimator, std::uint64_t seed,
               const Slalom& slalom) {
  QuadrotorModel vehicle(config, wind, estimator, seed, Vec3(0, 0, 5), kNoGround, UTime{});
  double squares = 0.0;
  Tracking result;
  constexpr int kBeats = 2500;
  for (int k = 0; k < kBeats; ++k) {
    const UavState setpoint = slalom.at(k * 0.01);
    vehicle.advance(setpoint.at);
    vehicle.command(setpoint);
    const double error = (vehicle.truth().motion.p - setpoint.motion.p).norm();
    squares += error * error;
    result.largest = std::max(result.largest, error);
  }
  result.rmse = std::sqrt(squares / kBeats);
  return result;
}

TEST(QuadrotorModel, TracksASlalomOfFiveMetresPerSecondInGustyWind) {
  for (const auto kind : {QuadrotorClass::Camera, QuadrotorClass::Racer}) {
    const Slalom slalom{5.0, kind == QuadrotorClass::Camera ? 7.0 : 14.0};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Tracking t = track(config_of(kind), {.speed = 8.0, .towards = 0.7}, {}, seed, slalom);
      EXPECT_LT(t.rmse, 0.15) << seed;
      EXPECT_LT(t.largest, 0.5) << seed;
    }
  }
}

TEST(QuadrotorModel, AControllerThreeTimesTooSoftIsFartherOff) {
  QuadrotorConfig soft = config_of(QuadrotorClass::Camera);
  soft.controller.position_p /= 3.0;
  soft.controller.velocity_p /= 3.0;
  const WindSpec wind{.speed = 8.0};
  const Slalom slalom{5.0, 7.0};
  EXPECT_GT(track(soft, wind, {}, 1, slalom).rmse,
            2.0 * track(config_of(QuadrotorClass::Camera), wind, {}, 1, slalom).rmse);
}

TEST(QuadrotorModel, FeedForwardDecides) {
  const Slalom slalom{5.0, 7.0};
  const QuadrotorConfig config = config_of(QuadrotorClass::Camera);
  QuadrotorModel vehicle(config, {}, {}, 1, Vec3(0, 0, 5), kNoGround, UTime{});
  double squares = 0.0;
  for (int k = 0; k < 2500; ++k) {
    UavState setpoint = slalom.at(k * 0.01);
    setpoint.motion.a = setpoint.motion.j = Vec3::Zero();
    vehicle.advance(setpoint.at);
    vehicle.command(setpoint);
    squares += (vehicle.truth().motion.p - setpoint.motion.p).squaredNorm();
  }
  EXPECT_GT(std::sqrt(squares / 2500), 3.0 * track(config, {}, {}, 1, slalom).rmse);
}

TEST(QuadrotorModel, IsAFunctionOfItsSeed) {
  const auto fly = [](std::uint64_t seed, Duration beat) {
    QuadrotorModel vehicle(config_of(QuadrotorClass::Racer), {.speed = 8.0},
                           {.position_sigma_m = 0.02, .drift_m = 0.1, .jump_m = 0.5, .jump_every_s = 2.0}, seed,
                           Vec3(0, 0, 5), kNoGround, UTime{});
    for (UTime t{}; t <= at_s(3.0); t = t + beat) vehicle.advance(t);
    return vehicle.truth().motion.p;
  };
  EXPECT_EQ(fly(1, Duration{10'000}), fly(1, Duration{1'000}));
  EXPECT_NE(fly(1, Duration{10'000}), fly(2, Duration{10'000}));
}

TEST(QuadrotorModel, AnEstimateThatJumpsMovesTheTruthTheOtherWay) {
  QuadrotorModel vehicle(config_of(QuadrotorClass::Camera), {}, {.jump_m = 0.6, .jump_at_s = 1.0}, 7, Vec3(0, 0, 5),
                         kNoGround, UTime{});
  vehicle.advance(at_s(1.01));
  const Vec3 jump = vehicle.estimate().motion.p - vehicle.truth().motion.p;
  EXPECT_NEAR(jump.norm(), 0.6, 1e-9);
  EXPECT_EQ(vehicle.resets(), 1);
  vehicle.advance(at_s(8.0));
  EXPECT_LT((vehicle.truth().motion.p - (Vec3(0, 0, 5) - jump)).norm(), 0.02);
}

TEST(QuadrotorModel, SaysItsEstimateLate) {
  QuadrotorModel vehicle(config_of(QuadrotorClass::Camera), {}, {.latency_s = 0.05}, 1, Vec3(0, 0, 5), kNoGround,
                         UTime{});
  vehicle.advance(at_s(0.04));
  EXPECT_FALSE(vehicle.delayed_estimate());
  vehicle.advance(at_s(1.0));
  ASSERT_TRUE(vehicle.delayed_estimate());
  EXPECT_EQ(vehicle.delayed_estimate()->at, at_s(0.95));
}

TEST(QuadrotorModel, HoldsWhereItsLastCommandEnds) {
  QuadrotorModel vehicle(config_of(QuadrotorClass::Camera), {}, {}, 1, Vec3(0, 0, 5), kNoGround, UTime{});
  UavState setpoint;
  setpoint.motion.p = Vec3(0, 0, 5);
  setpoint.motion.v = Vec3(2, 0, 0);
  vehicle.command(setpoint);
  vehicle.advance(at_s(10.0));
  EXPECT_LT((vehicle.truth().motion.p - Vec3(0.2, 0, 5)).norm(), 0.02);
}

TEST(QuadrotorModel, HeldItStandsStillInGustyWindAndFliesOnFromThere) {
  WindSpec wind;
  wind.speed = 8.0;
  const Vec3 start(0, 0, 5);
  QuadrotorModel vehicle(config_of(QuadrotorClass::Racer), wind, {}, 1, start, kNoGround, UTime{});
  vehicle.set_held(true);
  const Eigen::Quaterniond before = vehicle.truth().q;
  vehicle.advance(at_s(3));
  EXPECT_EQ(vehicle.truth().motion.p, start);
  EXPECT_EQ(vehicle.truth().motion.v, Vec3::Zero());
  EXPECT_EQ(vehicle.truth().motion.a, Vec3::Zero());
  EXPECT_EQ(vehicle.truth().q.coeffs(), before.coeffs());
  vehicle.set_held(false);
  vehicle.advance(at_s(5));
  EXPECT_NE(vehicle.truth().motion.p, start);
  EXPECT_LT((vehicle.truth().motion.p - start).norm(), 0.3);
}

TEST(QuadrotorModel, DisarmedItFallsAndStands) {
  QuadrotorModel vehicle(config_of(QuadrotorClass::Camera), {}, {}, 1, Vec3(0, 0, 2), 0.0, UTime{});
  vehicle.set_armed(false);
  vehicle.advance(at_s(3.0));
  EXPECT_TRUE(vehicle.truth().on_ground);
  vehicle.set_armed(true);
  vehicle.advance(at_s(10.0));
  EXPECT_LT((vehicle.truth().motion.p - Vec3(0, 0, 2)).norm(), 0.05);
}

}  // namespace
}  // namespace tern
