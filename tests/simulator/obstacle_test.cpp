#include "simulator/worlds/obstacle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_vector;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Motion>
WorldObstacle obstacle(const Motion& motion, const Vec3& centre = Vec3::Zero()) {
  ObstacleSpec spec;
  spec.centre = centre;
  spec.motion = motion;
  return WorldObstacle::make(0, spec).value();
}

template <class Motion>
std::string refusal(const Motion& motion) {
  ObstacleSpec spec;
  spec.name = "gate";
  spec.motion = motion;
  const auto made = WorldObstacle::make(7, spec);
  return made ? "accepted" : made.error().message;
}

TEST(Trefoil, IsTheFormulaOfTheBenchmarksWithThePhaseAddedOncePerTerm) {
  const Vec3 c(3, -2, 1);
  const WorldObstacle o = obstacle(TrefoilMotion{Vec3(0.5, 0.7, 0.9), 1.3, 0.4}, c);
  for (double t = 0.0; t < 20.0; t += 0.37) {
    const double w = t / 1.3;
    const Vec3 p(3 + 0.5 * (std::sin(w + 0.4) + 2 * std::sin(2 * w + 0.4)),
                 -2 + 0.7 * (std::cos(w + 0.4) - 2 * std::cos(2 * w + 0.4)), 1 - 0.9 * std::sin(3 * w + 0.4));
    EXPECT_LT((o.at(t).p - p).norm(), 1e-14);
  }
}

TEST(Wave, IsTheCentrePlusTheAmplitudeTimesASine) {
  const WorldObstacle o = obstacle(WaveMotion{Vec3(0, 0, -1), 2.0, 0.3}, Vec3(1, 2, 3));
  EXPECT_LT((o.at(5.0).p - Vec3(1, 2, 3 - std::sin(2.8))).norm(), 1e-15);
}

TEST(WorldObstacle, VelocityIsTheDerivativeAndItsBoundsHold) {
  Rng rng(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 k = random_vector(rng, 2.0);
    const double s = rng.uniform(0.5, 5.0);
    const double phase = rng.uniform(-6.0, 6.0);
    const WorldObstacle o = i % 2 == 0 ? obstacle(TrefoilMotion{k, s, phase}) : obstacle(WaveMotion{k, s, phase});
    const double t = rng.uniform(0.1, 30.0);
    const double h = 1e-3;
    const auto p = [&](double at) { return o.at(at).p; };
    EXPECT_LT((o.at(t).v - (p(t + h) - p(t - h)) / (2 * h)).norm(), 1e-3);
    const Vec3 a = (p(t + h) - 2 * p(t) + p(t - h)) / (h * h);
    const double H = 0.02;
    const Vec3 fourth = (p(t + 2 * H) - 4 * p(t + H) + 6 * p(t) - 4 * p(t - H) + p(t - 2 * H)) / (H * H * H * H);
    EXPECT_TRUE((o.at(t).v.cwiseAbs().array() <= o.bounds().speed.array() + 1e-12).all());
    EXPECT_TRUE((a.cwiseAbs().array() <= o.bounds().acceleration.array() + 1e-6).all());
    EXPECT_TRUE((fourth.cwiseAbs().array() <= o.bounds().fourth.array() + 1e-6).all());
  }
}

TEST(WorldObstacle, RestsBeforeTimeZeroWhereItIsAtZero) {
  const WorldObstacle trefoil = obstacle(TrefoilMotion{});
  EXPECT_EQ(trefoil.at(-3.0).p, trefoil.at(0.0).p);
  EXPECT_EQ(trefoil.at(-3.0).v, Vec3::Zero());
  EXPECT_EQ(trefoil.next_corner(-3.0), 0.0);
  const WorldObstacle linear = obstacle(LinearMotion{Vec3(1, 0, 0), -2.0});
  EXPECT_EQ(linear.at(-1.0).p, Vec3(2, 0, 0));
}

TEST(LinearMotion, WaitsUntilItsTime) {
  const WorldObstacle o = obstacle(LinearMotion{Vec3(1, 2, 0), 3.0}, Vec3(5, 5, 5));
  EXPECT_EQ(o.at(2.0).p, Vec3(5, 5, 5));
  EXPECT_EQ(o.at(5.0).p, Vec3(7, 9, 5));
  EXPECT_EQ(o.next_corner(1.0), 3.0);
  EXPECT_EQ(o.next_corner(3.0), kInfinity);
}

TEST(WaypointMotion, InterpolatesLinearlyAndRestsAtItsEnds) {
  const WorldObstacle o = obstacle(WaypointMotion{{{1.0, Vec3(0, 0, 0)}, {3.0, Vec3(4, 0, 0)}, {4.0, Vec3(4, 1, 0)}}});
  EXPECT_EQ(o.at(0.5).p, Vec3(0, 0, 0));
  EXPECT_EQ(o.at(2.0).p, Vec3(2, 0, 0));
  EXPECT_EQ(o.at(2.0).v, Vec3(2, 0, 0));
  EXPECT_EQ(o.at(9.0).p, Vec3(4, 1, 0));
  EXPECT_EQ(o.at(9.0).v, Vec3::Zero());
  EXPECT_EQ(o.bounds().speed, Vec3(2, 1, 0));
  EXPECT_EQ(o.next_corner(1.0), 3.0);
  EXPECT_TRUE(o.present(100.0));
}

TEST(WaypointMotion, GoesRoundForEverWhereItRepeats) {
  const WaypointMotion round{{{1.0, Vec3(0, 0, 0)}, {2.0, Vec3(1, 0, 0)}, {4.0, Vec3(0, 0, 0)}}, true, false};
  const WorldObstacle o = obstacle(round);
  for (double t = 0.0; t < 3.0; t += 0.125) {
    EXPECT_LT((o.at(t).p - o.at(t + 3.0).p).norm(), 1e-12);
    EXPECT_LT((o.at(t).p - o.at(t + 300.0).p).norm(), 1e-12);
  }
  EXPECT_DOUBLE_EQ(o.next_corner(4.5), 5.0);
}

TEST(WaypointMotion, VanishesOutsideItsTimes) {
  const WorldObstacle o = obstacle(WaypointMotion{{{1.0, Vec3(0, 0, 0)}, {3.0, Vec3(4, 0, 0)}}, false, true});
  EXPECT_FALSE(o.present(0.99));
  EXPECT_TRUE(o.present(1.0));
  EXPECT_TRUE(o.present(3.0));
  EXPECT_FALSE(o.present(3.01));
  const WorldObstacle early = obstacle(WaypointMotion{{{-1.0, Vec3(0, 0, 0)}, {3.0, Vec3(4, 0, 0)}}, false, true});
  EXPECT_TRUE(early.present(-50.0)) << "who is there at 0 rests there before";
  EXPECT_EQ(early.at(-50.0).p, Vec3(1, 0, 0));
}

TEST(WorldObstacle, RefusesWhatMakesNoMotionAndSaysWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(TrefoilMotion{Vec3::Ones(), 0.0, 0.0}),
              HasSubstr("obstacle 7 'gate': slowness 0, not in [0.001"));
  EXPECT_THAT(refusal(TrefoilMotion{Vec3(1, nan, 1), 1.0, 0.0}), HasSubstr("scale"));
  EXPECT_THAT(refusal(WaveMotion{Vec3::Ones(), 1.0, nan}), HasSubstr("phase"));
  EXPECT_THAT(refusal(LinearMotion{Vec3(nan, 0, 0), 0.0}), HasSubstr("velocity"));
  EXPECT_THAT(refusal(WaypointMotion{}), HasSubstr("no waypoints"));
  const Vec3 p = Vec3::Ones();
  EXPECT_THAT(refusal(WaypointMotion{{{1.0, p}, {1.0, p}}}), HasSubstr("waypoint 1: time 1 s"));
  EXPECT_THAT(refusal(WaypointMotion{{{1.0, p}, {1.0000001, p}}}), HasSubstr("1 us or more"));
  EXPECT_THAT(refusal(WaypointMotion{{{0.0, p}, {1.0, 2 * p}}, true, false}), HasSubstr("ends where it began"));
  EXPECT_THAT(refusal(WaypointMotion{{{0.0, p}, {1.0, p}}, true, true}), HasSubstr("exclude each other"));
  EXPECT_THAT(refusal(WaypointMotion{{{-2.0, p}, {-1.0, p}}, false, true}), HasSubstr("until after 0 s"));
  ObstacleSpec flat;
  flat.half_extents = Vec3(1, 0, 1);
  EXPECT_THAT(WorldObstacle::make(0, flat).error().message, HasSubstr("half-extents (1, 0, 1)"));
}

}  // namespace
}  // namespace tern
