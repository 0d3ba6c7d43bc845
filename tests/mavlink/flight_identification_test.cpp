// A flight measures the vehicle's drag and lag, and the next one flies better with them.
#include "mavlink/flight_identification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mavlink/bridge.h"
#include "tests/mavlink/flight_in_memory.h"

namespace tern::mavlink {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A figure of eight at up to 5 m/s and 5 m/s², from rest.
MotionSample eight(double t) {
  constexpr double kRate = 0.6, kRamp = 2.0, kLong = 7.0, kWide = 3.0;
  const double decay = std::exp(-t / kRamp), phase = kRate * (t - kRamp * (1.0 - decay));
  const double phase1 = kRate * (1.0 - decay), phase2 = kRate / kRamp * decay, phase3 = -phase2 / kRamp;
  const auto axis = [&](double size, double n, double& p, double& v, double& a, double& j) {
    const double s = size * std::sin(n * phase), c = size * n * std::cos(n * phase);
    p = s;
    v = c * phase1;
    a = -n * n * s * phase1 * phase1 + c * phase2;
    j = -n * n * c * phase1 * phase1 * phase1 - 3.0 * n * n * s * phase1 * phase2 + c * phase3;
  };
  MotionSample m{Vec3(0, 0, 2), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  axis(kLong, 1.0, m.p.x(), m.v.x(), m.a.x(), m.j.x());
  axis(kWide, 2.0, m.p.y(), m.v.y(), m.a.y(), m.j.y());
  return m;
}

struct Flown {
  std::optional<FlightIdentification::Answer> measured;
  double rmse = 0.0;
  std::vector<std::string> words;
};

Flown fly_eight(const SimulatedAutopilotConfig& vehicle, double drag_per_s, double lead_s) {
  FlightInMemory flight({.start = Start::Arm, .drag_per_s = drag_per_s, .lead_s = lead_s, .set_parameters = true},
                        vehicle);
  EXPECT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.path = eight;
  double squares = 0.0;
  int n = 0;
  flight.each = [&] {
    if (!flight.follows_since) return;
    const Vec3 commanded = eight((flight.now - *flight.follows_since).seconds()).p;
    squares += (flight.autopilot.model().truth().motion.p - commanded).squaredNorm();
    ++n;
  };
  flight.run(40.0);
  flight.each = nullptr;
  flight.bridge.land("the flight has ended");
  flight.run(0.5);
  return {flight.bridge.measured(), std::sqrt(squares / n), flight.words};
}

SimulatedAutopilotConfig vehicle_with(double drag_per_s, double wind) {
  SimulatedAutopilotConfig config;
  config.quadrotor.body.thrust_to_weight = 2.04;
  config.quadrotor.body.drag_per_s = config.quadrotor.body.drag_up_per_s = drag_per_s;
  config.quadrotor.body.drag_per_m = 0.0;
  config.wind.speed = wind;
  return config;
}

TEST(FlightIdentification, MeasuresDragAndLagAndTheNextFlightIsBetterByThem) {
  for (const double drag : {0.1, 1.0}) {
    const SimulatedAutopilotConfig vehicle = vehicle_with(drag, 0.0);
    const Flown first = fly_eight(vehicle, 0.5, 0.0);
    ASSERT_TRUE(first.measured) << drag;
    EXPECT_NEAR(first.measured->drag_per_s, drag, 0.1);
    EXPECT_NEAR(first.measured->share, 1.0, 0.1);
    EXPECT_THAT(first.words, Contains(HasSubstr("For the next flight: --set mavlink.drag_per_s=")));
    const Flown next = fly_eight(vehicle, first.measured->drag_per_s, first.measured->lag_s);
    EXPECT_LT(next.rmse, 0.12) << "m, at up to 5 m/s; before: " << first.rmse;
    EXPECT_LT(next.rmse, 0.5 * first.rmse);
  }
}

TEST(FlightIdentification, IsNotDeceivedByWind) {
  const Flown flown = fly_eight(vehicle_with(0.5, 3.0), 0.3, 0.0);
  ASSERT_TRUE(flown.measured);
  EXPECT_NEAR(flown.measured->drag_per_s, 0.5, 0.1);
}

TEST(FlightIdentification, SaysNothingAfterHovering) {
  FlightInMemory flight;
  ASSERT_TRUE(flight.run_until([&] { return flight.following(); }));
  flight.run(30.0);
  EXPECT_FALSE(flight.bridge.measured());
  flight.bridge.land("the flight has ended");
  flight.run(0.5);
  EXPECT_THAT(flight.words, Not(Contains(HasSubstr("measured in"))));
}

TEST(FlightIdentification, SaysNothingOfAnArduPilotWhoseGainsAreUnknown) {
  SimulatedAutopilotConfig copter = vehicle_with(0.5, 0.0);
  copter.manners = Manners::ArduPilot;
  EXPECT_FALSE(fly_eight(copter, 0.3, 0.0).measured);
}

}  // namespace
}  // namespace tern::mavlink
