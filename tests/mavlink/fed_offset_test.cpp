// Feed-forward for an ArduPilot, as an offset of its setpoints: alone, and in flights of the simulated ArduPilot.
#include "mavlink/fed_offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mavlink/bridge.h"
#include "mavlink/sim/guided_loops.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

constexpr double kPeriod = 0.02;
const MotionSample kRest{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

Vec3 wave(double t) { return {1.5 * std::sin(1.3 * t), 0.8 * std::cos(2.1 * t) - 0.8, 0.0}; }

TEST(FedOffset, TheLoopsOfAVehicleOnItsPathAnswerWithTheAcceleration) {
  constexpr double kInstant = 0.005;  // of the tilt, s
  for (const CopterLoops& loops :
       {CopterLoops{}, CopterLoops{.velocity_d = 0.0, .error_hz = 20.0}, CopterLoops{.position_p = 2.0}}) {
    FedOffset offset;
    GuidedLoops vehicle;
    for (double t = 0.0; t < 20.0; t += kPeriod) {
      const MotionSample setpoint = offset.step(wave(t), loops, kPeriod);
      MotionSample command;
      for (int k = 0; k < 20; ++k) command = vehicle.step(setpoint, kRest, loops, kInstant, kPeriod / 20);
      EXPECT_LT((command.a - wave(t)).norm(), 0.15) << t;
    }
  }
}

TEST(FedOffset, VanishesUnderAConstantAccelerationAndIsLevel) {
  FedOffset offset;
  double largest = 0.0;
  for (double t = 0.0; t < 20.0; t += kPeriod) {
    largest = std::max(largest, offset.step(Vec3(1.0, -1.0, 5.0), {}, kPeriod).p.norm());
    EXPECT_EQ(offset.offset().p.z(), 0.0);
    EXPECT_EQ(offset.offset().a.z(), 0.0);
  }
  EXPECT_LT(largest, 0.6);
  EXPECT_LT(offset.offset().p.norm(), 1e-3);
  EXPECT_LT(offset.offset().v.norm(), 1e-3);
}

/// slalom() without its jerk.
MotionSample smooth_slalom(double t) {
  constexpr double kSpeed = 4.0, kFor = 2.0, kBegin = 3.0, kRate = 1.2, kWide = 1.2;
  MotionSample m{Vec3(0, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const double s = std::min(t / kFor, 1.0), past = std::max(t - kFor, 0.0);
  m.p.x() = kSpeed * (kFor * (s * s * s - 0.5 * s * s * s * s) + past);
  m.v.x() = kSpeed * (3.0 - 2.0 * s) * s * s;
  m.a.x() = t < kFor ? kSpeed / kFor * 6.0 * s * (1.0 - s) : 0.0;
  const double u = std::max(t - kBegin, 0.0), decay = std::exp(-0.5 * u * u);
  const double e = 1.0 - decay, e1 = u * decay, e2 = (1.0 - u * u) * decay;
  const double sine = std::sin(kRate * u), cosine = std::cos(kRate * u);
  m.p.y() = kWide * sine * e;
  m.v.y() = kWide * (kRate * cosine * e + sine * e1);
  m.a.y() = kWide * (-kRate * kRate * sine * e + 2.0 * kRate * cosine * e1 + sine * e2);
  return m;
}

/// To 4 m/s along x within 2 s, then a slalom of 1.2 m beside it: 1.7 m/s², 2.1 m/s³.
MotionSample slalom(double t) {
  constexpr double kStep = 1e-3;
  MotionSample m = smooth_slalom(t);
  m.j = (smooth_slalom(t + kStep).a - m.a) / kStep;
  return m;
}

struct Errors {
  double rmse = 0.0, largest = 0.0;
};

/// Flies slalom() with a simulated Copter of this drag.
Errors fly_slalom(double drag_per_s, const BridgeConfig& bridge, double input_tc = 0.15) {
  SimulatedAutopilotConfig copter;
  copter.manners = Manners::ArduPilot;
  copter.quadrotor.body.drag_per_s = copter.quadrotor.body.drag_up_per_s = drag_per_s;
  copter.quadrotor.body.drag_per_m = 0.0;
  FlightInMemory flight(bridge, copter);
  flight.set_parameter("ATC_INPUT_TC", static_cast<float>(input_tc));
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); })) << flight.bridge.status(flight.now).why_not;
  flight.path = slalom;
  double squares = 0.0;
  int n = 0;
  Errors errors;
  flight.each = [&] {
    if (!flight.follows_since) return;
    const Vec3 commanded = slalom((flight.now - *flight.follows_since).seconds()).p;
    const double error = (flight.autopilot.model().truth().motion.p - commanded).norm();
    squares += error * error;
    errors.largest = std::max(errors.largest, error);
    ++n;
  };
  flight.run(20.0);
  EXPECT_TRUE(flight.following()) << flight.bridge.status(flight.now).why_not;
  errors.rmse = std::sqrt(squares / n);
  return errors;
}

TEST(FedOffset, IsBoundedAndFiniteWhateverTheGains) {
  for (const double gain : {1e4, -5.0, std::nan(""), 1e300}) {
    FedOffset fed;
    const CopterLoops loops{.velocity_p = gain};
    for (int k = 0; k < 1'000; ++k) {
      const MotionSample& offset = fed.step(Vec3(3, -1, 0), loops, 0.02);
      ASSERT_LE(offset.p.norm(), FedOffset::kLargest) << gain << ", step " << k;
      ASSERT_TRUE(offset.v.allFinite() && offset.a.allFinite()) << gain << ", step " << k;
    }
  }
}

TEST(FedOffset, ACopterFollowsASlalomAtFourMetresPerSecond) {
  for (const double drag : {0.15, 0.5}) {
    for (const double input_tc : {0.1, 0.15}) {
      const Errors errors =
          fly_slalom(drag, {.start = Start::Arm, .drag_per_s = drag, .set_parameters = true}, input_tc);
      EXPECT_LT(errors.rmse, 0.12) << drag << ", " << input_tc;
      EXPECT_LT(errors.largest, 0.3) << drag << ", " << input_tc;
    }
  }
}

TEST(FedOffset, WithoutFeedForwardTheSameCopterIsWhereArduPilotsSimulationWas) {
  const Errors errors =
      fly_slalom(0.3, {.start = Start::Arm, .drag_per_s = 0.0, .lead_s = 1e-3, .set_parameters = true});
  EXPECT_GT(errors.rmse, 0.14) << "measured: 0.15 to 0.20 m";
  EXPECT_GT(errors.largest, 0.35) << "measured: 0.46 to 0.66 m";
}

}  // namespace
}  // namespace tern::mavlink
