// Hidden ends of rendered obstacles end where empty space was seen, and never before the true end.
#include "predictor/faces/open_ends.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "tests/predictor/rendered_sightings.h"

namespace tern {
namespace {

using testing::RenderingSensor;

const Vec3 kEye(0, 0, 2);
constexpr double kError = 0.1;

double beyond(const std::vector<Box>& scene, const Box& seen, int axis, int side, double farthest = kFarthestEnd) {
  RenderingSensor camera = RenderingSensor::camera();
  return seen_empty_beyond(camera.frame(UTime{}, kEye, 0.0, scene).view, seen, axis, side, farthest, kError);
}

TEST(OpenEnds, LieBehindWhatHidesThem) {
  const Box beam(Vec3(6, -2, 1.8), Vec3(6.4, 1, 2.2)), pillar(Vec3(4, 0.2, 0), Vec3(4.4, 0.9, 4));
  // The shadow of the pillar covers y from 0.27 to 1.35 at x = 6. The beam is seen up to 0.27.
  const double rest = beyond({beam, pillar}, Box(beam.min(), Vec3(6.4, 0.27, 2.2)), 1, 1);
  EXPECT_GE(rest, 1.0 - 0.27);
  EXPECT_LE(rest, 1.35 - 0.27 + 3 * kEndStep);
}

TEST(OpenEnds, OutOfViewAreUnlimited) {
  const Box beam(Vec3(3, -9, 1.8), Vec3(3.4, 9, 2.2));
  EXPECT_EQ(beyond({beam}, Box(Vec3(3, -2.7, 1.8), Vec3(3.4, 2.7, 2.2)), 1, 1), kFarthestEnd);
  EXPECT_EQ(beyond({beam}, Box(Vec3(3, -2.7, 1.8), Vec3(3.4, 2.7, 2.2)), 1, 1, 3.0), 3.0);
}

TEST(OpenEnds, BehindAFaceAreUnlimited) {
  const Box cube(Vec3(5, -0.4, 1.6), Vec3(5.8, 0.4, 2.4));
  EXPECT_EQ(beyond({cube}, Box(cube.min(), Vec3(5.0, 0.4, 2.4)), 0, 1), kFarthestEnd);
}

TEST(OpenEnds, DoNotReachTheSensor) {
  const Box seen(Vec3(2, -0.2, 1.8), Vec3(2.4, 0.2, 2.2));
  SensorView blind;  // it saw nothing, but it is there
  blind.sensor_position = kEye;
  EXPECT_NEAR(seen_empty_beyond(blind, seen, 0, -1, kFarthestEnd, kError), 2.0 + kError, 1e-9);
  EXPECT_LT(beyond({seen}, seen, 0, -1), 1.0) << "the space before it was seen to be empty";
}

TEST(OpenEnds, MayPassTheSensor) {
  SensorView blind;
  blind.sensor_position = kEye;
  for (const double lateral : {0.01, 0.1, 0.3}) {
    const Box wall(Vec3(0.5, lateral, 1), Vec3(6, lateral + 0.2, 3));
    EXPECT_EQ(seen_empty_beyond(blind, wall, 0, -1, kFarthestEnd, kError), kFarthestEnd) << lateral << " m beside it";
  }
}

// A beam at a random place, partly behind a random pillar. Whatever part of it was seen, its rest is no longer than
// the space that is left to it.
TEST(OpenEnds, AreNeverNearerThanTheTrueEnd) {
  Rng rng(5);
  RenderingSensor camera = RenderingSensor::camera();
  int limited = 0, all = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int axis = rng.uniform() < 0.5 ? 1 : 2;
    Vec3 half = Vec3::Constant(0.2);
    half[axis] = rng.uniform(0.5, 2.5);
    const Box beam = box_around(Vec3(rng.uniform(4.0, 8.5), rng.uniform(-2, 2), rng.uniform(1, 3)), half);
    const Box pillar =
        box_around(Vec3(rng.uniform(2.0, 3.5), rng.uniform(-1, 1), 2), Vec3(0.2, rng.uniform(0.1, 0.5), 2));
    const SensorView view = camera.frame(UTime{}, kEye, 0.0, {beam, pillar}).view;
    for (const int side : {-1, 1}) {
      Box seen = beam;
      const double hidden = rng.uniform(0.0, 1.0) * beam.sizes()[axis];
      (side < 0 ? seen.min() : seen.max())[axis] -= side * hidden;
      const double rest = seen_empty_beyond(view, seen, axis, side, kFarthestEnd, kError);
      ASSERT_GE(rest + kEndStep, hidden) << "trial " << trial;
      limited += rest < kFarthestEnd ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(limited, all / 2);
}

}  // namespace
}  // namespace tern
