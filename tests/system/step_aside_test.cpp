// A stationary vehicle, gentle or quick, and boxes that come at it on declared paths: it evades wherever it can.
#include "core/scenario/step_aside.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "campaign/experiments/avoidable.h"
#include "tests/support/effort.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

struct Vehicle {
  double v_max, a_max, j_max;
};

/// One box on a straight line through the vehicle, from 8 m away.
World box_at(double half, double speed, const Vec3& start) {
  ObstacleSpec box;
  box.centre = start + Vec3(0, 8, 0);
  box.half_extents = Vec3::Constant(half);
  box.motion = LinearMotion{Vec3(0, -speed, 0), 0.0};
  World world;
  world.obstacles.push_back(WorldObstacle::make(0, box).value());
  return world;
}

bool can_step_aside(const Vehicle& v, const World& world, const Vec3& start, double until_s) {
  RestingVehicle vehicle;
  vehicle.start = start;
  vehicle.limits = {Vec3::Constant(v.v_max), Vec3(v.a_max, v.a_max, 0.5 * v.a_max), Vec3::Constant(v.j_max)};
  vehicle.flight_box = Box(Vec3(-50, -50, 0), Vec3(50, 50, 100));
  MoveSearch search;
  search.until_s = until_s;
  // A motion is known 4.5 s ahead.
  const WorldObstacle& box = world.obstacles.front();
  const double touches_s = (8.0 - box.half_extents().y() - 0.1) / box.bounds().speed.y();
  search.earliest_s = std::max(search.earliest_s, touches_s - 4.5 + search.earliest_s);
  return clear_moves(vehicle, world, 1, search) > 0;
}

class StepAsideOf : public ::testing::TestWithParam<Vehicle> {};

TEST_P(StepAsideOf, OneBoxWheneverRandomMovesFindAWayOut) {
  const Vehicle& v = GetParam();
  const Vec3 start(0, 0, 50);
  // Usually the least and the largest of both.
  for (const double half : support::first_at_effort<double>(2, {0.3, 1.5, 0.6})) {
    for (const double speed : support::first_at_effort<double>(2, {0.5, 4.0, 1.0, 2.0})) {
      const double passed_s = (8.0 + 2.0 * half + 1.0) / speed;
      const World world = box_at(half, speed, start);
      if (!can_step_aside(v, world, start, passed_s)) continue;
      const VirtualFlight flight = fly_virtually(
          scenario_file("step_aside"),
          {"world.generator=none",
           fmt::format(
               "world.obstacles=[{{centre: [0, 8, 50], half_extents: {}, motion: linear, velocity: [0, {}, 0]}}]", half,
               -speed),
           fmt::format("uav.limits={{v_max: {}, a_max: [{}, {}, {}], j_max: {}}}", v.v_max, v.a_max, v.a_max,
                       0.5 * v.a_max, v.j_max > 1e6 ? "inf" : fmt::to_string(v.j_max)),
           fmt::format("simulator.min_flight_s={}", passed_s)});
      EXPECT_NE(flight.result.outcome, FlightOutcome::Collision)
          << "half " << half << " m at " << speed << " m/s: " << flight.result.detail;
      EXPECT_EQ(flight.result.limit_violations, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, StepAsideOf,
                         ::testing::Values(Vehicle{6, 20, INFINITY}, Vehicle{2, 2, 5}, Vehicle{1.5, 3, INFINITY},
                                           Vehicle{1, 1, 5}, Vehicle{0.5, 1, 10}),
                         [](const auto& vehicle) { return fmt::format("Of{}cmps", vehicle.param.v_max * 100); });

/// Flies the encounter of this seed. After a contact, none of 10,000 random moves may avoid it.
void expect_no_avoidable_contact(std::uint64_t seed) {
  const Vec3 start(0, 0, 50);
  const VirtualFlight flight = fly_virtually(scenario_file("step_aside"), {fmt::format("seed={}", seed)});
  ASSERT_TRUE(flight.end.empty()) << flight.end;
  EXPECT_EQ(flight.result.limit_violations, 0) << "seed " << seed;
  if (flight.result.outcome != FlightOutcome::Collision) return;
  const StepAside drawn = draw_step_aside(seed, start);
  World world;
  for (const ObstacleSpec& mover : drawn.movers) {
    world.obstacles.push_back(WorldObstacle::make(static_cast<std::int64_t>(world.obstacles.size()), mover).value());
  }
  const RestingVehicle vehicle{start, drawn.limits, drawn.body, Box(Vec3(-50, -50, 0), Vec3(50, 50, 100))};
  EXPECT_EQ(clear_moves(vehicle, world, seed, {}), 0) << "seed " << seed << " was hit: " << flight.result.detail;
}

TEST(StepAside, TouchesNothingThatRandomMovesAvoidInDrawnEncounters) {
  const auto encounters = static_cast<std::uint64_t>(support::listed_at_effort(8, 40));
  for (std::uint64_t seed = 1; seed <= encounters; ++seed) expect_no_avoidable_contact(seed);
}

TEST(StepAside, DoesNotTurnBackToAGoalWhereItIsHitSooner) { expect_no_avoidable_contact(402); }

}  // namespace
}  // namespace tern::testing
