#include "simulator/worlds/drawn_recordings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "simulator/worlds/appearances.h"
#include "simulator/worlds/generators.h"
#include "simulator/worlds/obstacle.h"

namespace tern {
namespace {

using ::testing::HasSubstr;

RecordedTracksSpec ten_frames_a_second() {
  RecordedTracksSpec spec;
  spec.file = "people.txt";
  spec.frames_per_second = 10.0;
  return spec;
}

/// A person walks along x at y, 1 m/s, at x = 0 at time `there_s`; recorded each second for 20 s.
RecordedTrack walker(double there_s, double y) {
  RecordedTrack track;
  for (int k = 0; k <= 20; ++k) track.points.emplace_back(there_s + k - 10.0, Vec3(k - 10.0, y, 1));
  return track;
}

/// 6 m along y, across the walkers' path.
UavSpec crossing() {
  UavSpec uav;
  uav.start = Vec3(0, -3, 1);
  uav.goal = Vec3(0, 3, 1);
  uav.limits.v_max = Vec3::Constant(3);
  uav.limits.a_max = Vec3::Constant(10);
  return uav;
}

TEST(DrawnStart, IsAWholeFrameAtWhichSomebodyIsMet) {
  const std::vector<RecordedTrack> tracks = {walker(30.0, 0.0), walker(500.0, 0.0)};
  const double bound = rest_to_rest_bound_s(crossing().start, crossing().goal, crossing().limits);
  std::set<double> starts;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed);
    const double t = draw_start(rng, tracks, ten_frames_a_second(), crossing()).value();
    EXPECT_NEAR(t * 10.0, std::round(t * 10.0), 1e-9);
    const double middle = t + bound / 2;  // the vehicle crosses y = 0 then
    EXPECT_LT(std::min(std::abs(middle - 30.0), std::abs(middle - 500.0)), 1.6) << "seed " << seed;
    starts.insert(t);
  }
  EXPECT_GT(starts.size(), 15U);
}

TEST(DrawnStart, WhereNobodyIsEverMetIsAnError) {
  Rng rng(1);
  const auto start = draw_start(rng, {walker(30.0, 50.0)}, ten_frames_a_second(), crossing());
  EXPECT_THAT(start.error().message, HasSubstr("nobody comes within 1 m"));
}

TEST(CrowdsStart, WhoIsWithinAMetreInTheFirstSecond) {
  EXPECT_TRUE(crowds_start(walker(10.0, 0.0), 9.5, Vec3(0, 0.5, 9))) << "on the floor, whatever the height";
  EXPECT_TRUE(crowds_start(walker(10.0, 0.0), 8.5, Vec3(0, 0.5, 1)));
  EXPECT_FALSE(crowds_start(walker(10.0, 0.0), 7.9, Vec3(0, 0.0, 1)));
  EXPECT_FALSE(crowds_start(walker(10.0, 0.0), 50.0, Vec3(10, 0.0, 1))) << "gone by then";
}

/// A closed path of 9 s at 2 m/s, within 6 m × 3 m × 0 m.
RecordedTrack racer() {
  RecordedTrack track;
  for (int k = 0; k <= 900; ++k) {
    const double t = 0.01 * k;
    const double s = 2.0 * t;
    const Vec3 p = s < 6 ? Vec3(s, 0, 7) : s < 9 ? Vec3(6, s - 6, 7) : s < 15 ? Vec3(15 - s, 3, 7) : Vec3(0, 18 - s, 7);
    track.points.emplace_back(100.0 + t, p);
  }
  return track;
}

RecordedTracksSpec eight_copies() {
  RecordedTracksSpec spec;
  spec.file = "drone/racer.txt";
  spec.half_extents = Vec3::Constant(0.2);
  spec.copies = 8;
  spec.within = Box(Vec3(-10, -10, 0), Vec3(10, 10, 6));
  return spec;
}

TEST(ScatteredCopies, FlyAsTheTrackDoesWithinTheirBoxClearOfTheStart) {
  const Vec3 start(0, 0, 3);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    const auto made = scatter_copies(rng, {racer()}, eight_copies(), start, 5.0);
    ASSERT_TRUE(made);
    ASSERT_EQ(made->obstacles.size(), 8U);
    for (const ObstacleSpec& o : made->obstacles) {
      const auto& motion = std::get<WaypointMotion>(o.motion);
      EXPECT_TRUE(
          std::any_of(motion.points.begin(), motion.points.end(), [](const auto& p) { return p.first == 0.0; }));
      EXPECT_LE(motion.points.front().first, 0.0) << "who looks before world time 0 sees it come";
      EXPECT_GE(motion.points.front().first, -2.0);
      EXPECT_NEAR(motion.points.back().first, 5.0, 0.011);
      for (double t = 0.0; t < 4.9; t += 0.1) {
        const ObstacleState state = motion_state(o, t);
        EXPECT_NEAR(state.v.norm(), 2.0, 0.6) << "corners are cut";
        EXPECT_LT(eight_copies().within.exteriorDistance(state.p), 1e-9);
        if (t <= kStartQuiet) {
          EXPECT_GE(distance_to_box(start, state.p, o.half_extents), kStartClearance);
        }
      }
    }
  }
}

TEST(ScatteredCopies, AreAFunctionOfTheDraws) {
  const auto first_of = [](std::uint64_t seed) {
    Rng rng(seed);
    return scatter_copies(rng, {racer()}, eight_copies(), Vec3(0, 0, 3), 5.0)->obstacles.front().centre;
  };
  EXPECT_EQ(first_of(7), first_of(7));
  EXPECT_NE(first_of(7), first_of(8));
}

TEST(ScatteredCopies, WithoutRoomAreAnError) {
  RecordedTracksSpec spec = eight_copies();
  spec.within = Box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1));
  Rng rng(1);
  const auto made = scatter_copies(rng, {racer()}, spec, Vec3(0, 0, 0.5), 1.0);
  if (!made) {
    EXPECT_THAT(made.error().message, HasSubstr("no place for copy"));
  }
}

ObstacleSpec appearing(double at_s, const Vec3& where) {
  ObstacleSpec o;
  o.half_extents = Vec3::Constant(0.5);
  o.motion = WaypointMotion{{{at_s, where}, {at_s + 5, where + Vec3::UnitX()}}, false, true, 3.0};
  return o;
}

TEST(Appearances, BesideTheVehicleAreLeftOutAndOthersAreNot) {
  Scenario s;
  s.world.obstacles = {appearing(2.0, Vec3(5, 0, 0)), appearing(4.0, Vec3(5, 0, 0)), appearing(-1.0, Vec3(5, 0, 0))};
  World world = make_world(s, "").value();
  Appearances appearances(world);
  const auto vehicle = [](double t) { return Vec3(t, 0, 0); };
  EXPECT_EQ(appearances.admit(world, 3.9, vehicle), 1) << "at 2 s the box is 2.5 m away";
  EXPECT_FALSE(world.obstacles[0].present(2.0));
  EXPECT_TRUE(world.obstacles[1].present(4.0)) << "nobody has asked yet";
  EXPECT_EQ(appearances.admit(world, 4.0, vehicle), 1);
  EXPECT_FALSE(world.obstacles[1].present(4.0));
  EXPECT_TRUE(world.obstacles[2].present(0.0)) << "was there from the beginning";
}

TEST(Appearances, FarFromTheVehicleStay) {
  Scenario s;
  s.world.obstacles = {appearing(2.0, Vec3(5.51, 0, 0))};
  World world = make_world(s, "").value();
  Appearances appearances(world);
  EXPECT_EQ(appearances.admit(world, 9.0, [](double t) { return Vec3(t, 0, 0); }), 0);
  EXPECT_TRUE(world.obstacles[0].present(2.0));
}

}  // namespace
}  // namespace tern
