#include "simulator/referee/clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/world/body_distance.h"
#include "simulator/referee/first_time.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

World world_of(const std::vector<ObstacleSpec>& specs) {
  Scenario s;
  s.world.obstacles = specs;
  return make_world(s, "").value();
}

ObstacleSpec box_at(const Vec3& c, const Vec3& h, decltype(ObstacleSpec::motion) motion = StaticMotion{}) {
  ObstacleSpec o;
  o.centre = c;
  o.half_extents = h;
  o.motion = std::move(motion);
  return o;
}

FlownPiece straight(const Vec3& from, const Vec3& velocity) {
  FlownPiece piece;
  piece.coefficients.col(2) = velocity;
  piece.coefficients.col(3) = from;
  return piece;
}

/// Steps of 10 ms over [0, duration]; the first contact.
std::optional<Contact> fly(ClearanceWatch& watch, const FlownPiece& piece, double from_s, double to_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to_s - from_s) / 0.01)));
  for (int k = 0; k < steps; ++k) {
    const auto at = [&](int i) { return from_s + (to_s - from_s) * i / steps; };
    if (const auto contact = watch.advance(piece, at(k), at(k + 1))) return contact;
  }
  return std::nullopt;
}

/// The least clearance at instants `step` apart.
double by_sampling(const World& world, const Body& body, const FlownPiece& piece, double from, double to, double step) {
  const BodyDistance distance(body);
  double least = std::numeric_limits<double>::infinity();
  for (double t = from; t <= to; t += step) {
    const Vec3 p = piece.at(t).p;
    for (const WorldObstacle& o : world.obstacles) {
      if (o.present(t)) least = std::min(least, distance(p - o.at(t).p, o.half_extents()));
    }
  }
  return least;
}

TEST(FirstTime, FindsADipBetweenSamples) {
  const auto dip = [](double t) { return std::abs(t - 0.3337) - 1e-4; };
  const auto found = first_time_below_zero(dip, 1.0, 0.0, 1.0, 1e-6);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.3336, 2e-6);
  EXPECT_FALSE(first_time_below_zero([](double t) { return std::abs(t - 0.3337) + 1e-4; }, 1.0, 0.0, 1.0, 1e-6));
}

TEST(Clearance, AgreesWithDenseSamplingOfRandomFlights) {
  Rng rng(11);
  int touched = 0;
  for (int i = 0; i < 60; ++i) {
    Scenario s;
    s.seed = static_cast<std::uint64_t>(i + 1);
    s.world.generator = i % 2 == 0 ? "paper_corridor" : "mader_corridor";
    s.world.count = 60;
    const World world = make_world(s, "").value();
    const Body body{Points::Zero(3, 1), 0.1};
    FlownPiece piece = straight(Vec3(rng.uniform(5, 60), rng.uniform(-2, 2), rng.uniform(0.5, 3.5)),
                                Vec3(rng.uniform(-6, 6), rng.uniform(-2, 2), rng.uniform(-1, 1)));
    piece.coefficients.col(1) = support::random_vector(rng, 2.0);
    piece.coefficients.col(0) = support::random_vector(rng, 1.0);
    ClearanceWatch watch(world, body);
    const auto contact = fly(watch, piece, 0.0, 1.0);
    const double to = contact ? contact->time_s : 1.0;
    constexpr double kStep = 2e-4;
    const double sampled = by_sampling(world, body, piece, 0.0, to, kStep);
    const double between = (piece.speed_bound(0, 1) + 9.0) * kStep / 2;
    EXPECT_LE(contact ? 0.0 : watch.min_clearance(), std::max(0.0, sampled) + kClearanceTolerance) << "seed " << i + 1;
    if (!contact) {
      EXPECT_GE(watch.min_clearance(), sampled - between) << "seed " << i + 1;
    }
    if (contact && to > 0.0) {
      EXPECT_GE(sampled, -between) << "overlap before the first contact";
    }
    touched += contact ? 1 : 0;
  }
  EXPECT_GT(touched, 5);
  EXPECT_LT(touched, 55);
}

TEST(Clearance, CatchesAGrazeBetweenSamples) {
  // 6 m/s: samples 6 cm apart; a 2 cm cube just off the line, halfway between two of them.
  const Body body{Points::Zero(3, 1), 0.005};
  const auto flown = [&](double gap) {
    const World world = world_of({box_at(Vec3(0.63, 0.015 + gap, 0), Vec3::Constant(0.01))});
    ClearanceWatch watch(world, body);
    const auto contact = fly(watch, straight(Vec3::Zero(), Vec3(6, 0, 0)), 0.0, 0.2);
    return std::make_pair(contact.has_value(), watch.min_clearance());
  };
  EXPECT_TRUE(flown(-1e-5).first) << "10 um deep";
  EXPECT_NEAR(flown(-1e-5).second, -1e-5, 1e-6);
  EXPECT_FALSE(flown(1e-5).first) << "10 um clear";
  EXPECT_NEAR(flown(1e-5).second, 1e-5, kClearanceTolerance);
  EXPECT_GT(flown(1e-5).second, 0.0);
}

TEST(Clearance, CatchesAFastObstacleThatCrossesWithinAStep) {
  // 100 m/s across the hovering vehicle: 1 m per step, a 0.1 m cube.
  const World world = world_of({box_at(Vec3(0, -3.55, 0), Vec3::Constant(0.05), LinearMotion{Vec3(0, 100, 0), 0.0})});
  ClearanceWatch watch(world, {Points::Zero(3, 1), 0.02});
  const auto contact = fly(watch, straight(Vec3::Zero(), Vec3::Zero()), 0.0, 0.1);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->time_s, (3.55 - 0.07) / 100.0, 2e-6);
}

TEST(Clearance, FindsTheFirstContactOfSeveral) {
  const World world =
      world_of({box_at(Vec3(1.03, 0, 0), Vec3::Constant(0.01)), box_at(Vec3(1.0, 0, 0), Vec3::Constant(0.01))});
  ClearanceWatch watch(world, {Points::Zero(3, 1), 0.0});
  const auto contact = fly(watch, straight(Vec3::Zero(), Vec3(10, 0, 0)), 0.0, 1.0);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->id, 1);
  EXPECT_NEAR(contact->time_s, 0.099, 2e-6);
}

TEST(Clearance, TurnsWithTheCornersOfWaypointMotions) {
  // Comes straight at the vehicle, turns away 2 mm before it touches, in the middle of a step.
  const WaypointMotion touch_and_go{{{0.0, Vec3(3, 0, 0)}, {0.505, Vec3(0.112, 0, 0)}, {1.0, Vec3(3, 0, 0)}}};
  const World world = world_of({box_at(Vec3::Zero(), Vec3::Constant(0.01), touch_and_go)});
  ClearanceWatch watch(world, {Points::Zero(3, 1), 0.1});
  EXPECT_FALSE(fly(watch, straight(Vec3::Zero(), Vec3::Zero()), 0.0, 1.0));
  EXPECT_NEAR(watch.min_clearance(), 0.002, 1e-9);
}

TEST(Clearance, IgnoresWhoIsAbsent) {
  const WaypointMotion passing{{{1.0, Vec3::Zero()}, {2.0, Vec3(5, 0, 0)}}, false, true};
  const World world = world_of({box_at(Vec3::Zero(), Vec3::Constant(0.1), passing)});
  ClearanceWatch early(world, {Points::Zero(3, 1), 0.1});
  EXPECT_FALSE(fly(early, straight(Vec3::Zero(), Vec3::Zero()), 0.0, 0.99));
  EXPECT_TRUE(std::isinf(early.min_clearance()));
  ClearanceWatch meets(world, {Points::Zero(3, 1), 0.1});
  const auto contact = fly(meets, straight(Vec3::Zero(), Vec3::Zero()), 0.0, 1.5);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->time_s, 1.0, 1e-9) << "who appears in the vehicle touches it at once";
}

TEST(Clearance, SaysHowDeepAnOverlapGoes) {
  const World world = world_of({box_at(Vec3::Zero(), Vec3::Ones())});
  ClearanceWatch watch(world, {Points::Zero(3, 1), 0.1});
  EXPECT_TRUE(watch.advance(straight(Vec3(0.5, 0, 0), Vec3::Zero()), 0.0, 0.01));
  EXPECT_DOUBLE_EQ(watch.min_clearance(), -0.6);
}

TEST(Clearance, OfLongStepsIsThatOfShortOnes) {
  Scenario s;
  s.world.generator = "paper_corridor";
  s.world.count = 40;
  const World world = make_world(s, "").value();
  const Body body{Points::Zero(3, 1), 0.1};
  const FlownPiece piece = straight(Vec3(0, -6, 1), Vec3(6, 0.3, 0.1));
  ClearanceWatch fine(world, body);
  ClearanceWatch coarse(world, body);
  EXPECT_FALSE(fly(fine, piece, 0.0, 4.0));
  EXPECT_FALSE(coarse.advance(piece, 0.0, 4.0));
  EXPECT_NEAR(fine.min_clearance(), coarse.min_clearance(), kClearanceTolerance);
}

}  // namespace
}  // namespace tern
