#include "planner/start_clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "core/geometry/separation.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kNow{50'000'000};
/// clear_start() leaves at most this much more room than necessary, m.
constexpr double kSlack = 2e-3;

/// Returns the distance between the body at the origin and a box, m.
double room(const Body& body, const Box& box) { return distance(box_corners(box), body.vertices) - body.radius; }

TEST(ClearStart, ScalesAlphaToTheLargestValueThatLeavesTheBodyClear) {
  int relaxed = 0;
  int collided = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Rng rng(seed);
    Track track =
        straight_mover(1, random_vector(rng, 0.5), random_vector(rng, 1.0), 0.2, kNow - Duration{100'000}, 1.0);
    track.alpha[0] =
        Vec3(rng.uniform(0.0, 0.8), rng.uniform(0.0, 0.8), rng.uniform() < 0.3 ? 0.0 : rng.uniform(0.0, 0.8));
    const std::vector<Track> tracks{track};
    auto obstacles = obstacles_of(tracks);
    const Body body = body_of(kBodyKinds[seed % 3]);
    const StartClearance result = clear_start(obstacles, body, Vec3::Zero(), kNow);
    const double scale = obstacles[0].alpha.scale;
    ASSERT_GE(scale, 0.0);
    ASSERT_LE(scale, 1.0);
    const Box bare = promised_box(track, kNow, {0, 0.0});
    if (result.collides) {
      ++collided;
      ASSERT_LE(room(body, bare), kSlack) << "seed " << seed;
      continue;
    }
    ASSERT_EQ(result.relaxed, scale < 1.0) << "seed " << seed;
    const Box now = promised_box(track, kNow, {0, scale});
    ASSERT_GT(room(body, now), kTouchingTolerance) << "seed " << seed;
    if (!result.relaxed) continue;
    ++relaxed;
    ASSERT_LE(room(body, now), kSlack) << "seed " << seed << ": α could have been larger";
  }
  EXPECT_GT(relaxed, 500);
  EXPECT_GT(collided, 100);
}

TEST(ClearStart, ASphereBesideACornerIsNotInsideTheBox) {
  Track track = straight_mover(1, Vec3(0.28, 0.28, 0), Vec3::Zero(), 0.1, kNow, 1.0);
  track.alpha[0] = Vec3::Constant(0.1);  // the corner is 0.08·√2 = 0.113 m away, the sphere's radius 0.1 m
  const std::vector<Track> tracks{track};
  auto obstacles = obstacles_of(tracks);
  const StartClearance result = clear_start(obstacles, Body{}, Vec3::Zero(), kNow);
  EXPECT_FALSE(result.relaxed);
  EXPECT_FALSE(result.collides);
}

TEST(ClearStart, LeavesWhatIsFarAlone) {
  const std::vector<Track> tracks{straight_mover(1, Vec3(3, 0, 0), Vec3::Zero(), 0.4, kNow, 1.0)};
  auto obstacles = obstacles_of(tracks);
  const StartClearance result = clear_start(obstacles, Body{}, Vec3::Zero(), kNow);
  EXPECT_FALSE(result.relaxed);
  EXPECT_FALSE(result.collides);
  EXPECT_EQ(obstacles[0].alpha.scale, 1.0);
}

TEST(ClearStart, TakesTheAlphaOfThePieceThatIsInForce) {
  Track track = straight_mover(1, Vec3(0.4, 0, 0), Vec3::Zero(), 0.2, kNow - Duration{1'000'000}, 1.0);
  track.motion.pieces.push_back(track.motion.pieces[0]);
  track.alpha = {Vec3::Constant(0.5), Vec3::Constant(0.05)};
  const std::vector<Track> tracks{track};
  auto obstacles = obstacles_of(tracks);
  EXPECT_FALSE(clear_start(obstacles, Body{}, Vec3::Zero(), kNow + Duration{500'000}).relaxed);
  EXPECT_TRUE(clear_start(obstacles, Body{}, Vec3::Zero(), kNow - Duration{500'000}).relaxed);
}

TEST(ClearStart, ABoxOfTheMapHasNoAlphaToGive) {
  std::vector<PlanningObstacle> obstacles{{-1, nullptr, box_around(Vec3(0.25, 0, 0), Vec3::Constant(0.2)), {}}};
  const StartClearance result = clear_start(obstacles, Body{}, Vec3::Zero(), kNow);
  EXPECT_TRUE(result.collides);
  EXPECT_FALSE(result.relaxed);
  EXPECT_EQ(obstacles[0].alpha.scale, 1.0);
}

/// A box of the map at x = 0.25 m, of half-extents 0.1 m, grown by a margin.
std::vector<PlanningObstacle> map_box_with(double margin) {
  return {{-1, nullptr, box_around(Vec3(0.25, 0, 0), Vec3::Constant(0.1 + margin)), {}, nullptr, margin}};
}

TEST(ClearStart, ABoxOfTheMapGivesOfItsMargin) {
  for (const double margin : {0.03, 0.1, 0.7}) {
    auto obstacles = map_box_with(margin);
    const StartClearance result = clear_start(obstacles, Body{}, Vec3::Zero(), kNow);  // a radius of 0.1 m
    EXPECT_FALSE(result.collides);
    EXPECT_EQ(result.relaxed, margin > 0.05);
    const Box applied = obstacles[0].map_box(obstacles[0].alpha.scale);
    EXPECT_NEAR(applied.min().x(), std::max(0.15 - margin, 0.1), result.relaxed ? kSlack : 1e-12) << margin;
  }
}

TEST(LeaveTouched, AFloorIsTouchedWithoutItsMargin) {
  std::vector<PlanningObstacle> obstacles{
      {-1, nullptr, Box(Vec3(-3.2, -3.2, -1.2), Vec3(3.2, 3.2, 0.1)), {}, nullptr, 0.2}};
  const Box side = leave_touched(obstacles, Body{}, Vec3::Zero());
  EXPECT_TRUE(obstacles.empty());
  EXPECT_EQ(side.min().z(), 0.0);
}

/// The floor under a sphere of 0.1 m at the origin; `gap` between them.
std::vector<PlanningObstacle> floor_below(double gap) {
  return {{-1, nullptr, Box(Vec3(-3, -3, -1), Vec3(3, 3, -0.1 - gap)), {}}};
}

TEST(LeaveTouched, ConfinesTheCentreToItsSideOfAFaceThatItTouches) {
  auto obstacles = floor_below(0.0);
  const Box side = leave_touched(obstacles, Body{}, Vec3::Zero());
  EXPECT_TRUE(obstacles.empty());
  EXPECT_EQ(side.min().z(), 0.0);
  EXPECT_TRUE(std::isinf(side.max().z()));
  EXPECT_TRUE(std::isinf(side.min().x()));
  EXPECT_FALSE(clear_start(obstacles, Body{}, Vec3::Zero(), kNow).collides);

  const std::vector<Track> ceiling{standing_box(7, Box(Vec3(-3, -3, 0.1), Vec3(3, 3, 1)), kNow)};
  auto above = obstacles_of(ceiling);
  EXPECT_EQ(leave_touched(above, Body{}, Vec3::Zero()).max().z(), 0.0);
  EXPECT_TRUE(above.empty());
}

TEST(LeaveTouched, LeavesAloneWhatTheBodyOverlapsOrDoesNotTouch) {
  for (const double gap : {-1e-3, -1e-5, 1e-5, 1e-3}) {
    auto obstacles = floor_below(gap);
    EXPECT_TRUE(std::isinf(leave_touched(obstacles, Body{}, Vec3::Zero()).min().z())) << gap;
    ASSERT_EQ(obstacles.size(), 1u) << gap;
    EXPECT_EQ(clear_start(obstacles, Body{}, Vec3::Zero(), kNow).collides, gap < 0.0) << gap;
  }
  // The bounds of the sphere touch this box, the sphere does not.
  std::vector<PlanningObstacle> beside{{-1, nullptr, Box(Vec3(0.1, 0.08, 0.08), Vec3(1, 1, 1)), {}}};
  EXPECT_TRUE(std::isinf(leave_touched(beside, Body{}, Vec3::Zero()).max().x()));
  EXPECT_EQ(beside.size(), 1u);
  // A mover that touches is no ground.
  const std::vector<Track> movers{straight_mover(1, Vec3(0, 0, -0.3), Vec3(0.1, 0, 0), 0.2, kNow, 1.0)};
  auto moving = obstacles_of(movers);
  EXPECT_TRUE(std::isinf(leave_touched(moving, Body{}, Vec3::Zero()).min().z()));
  EXPECT_EQ(moving.size(), 1u);
}

}  // namespace
}  // namespace tern
