#include "perception/detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "tests/perception/scene.h"

namespace tern {
namespace {

using support::camera;
using support::lidar;
using support::Scene;
using ::testing::ElementsAre;

constexpr auto kFace = BoundSight::Face, kWhole = BoundSight::Whole, kOccluded = BoundSight::Occluded,
               kCut = BoundSight::Cut, kTouching = BoundSight::Touching, kUnseen = BoundSight::Unseen;

const SensorPose kAhead = looking(Vec3(0, 0, 1), 0.0);

std::vector<Sighting> seen(const DepthSensor& sensor, const std::vector<Box>& boxes,
                           const KnownSurroundings& known = {}, const SensorPose& pose = kAhead) {
  Scene scene(sensor);
  scene.render(pose, boxes, known.ground_z);
  return Detector().detect(scene.picture, known);
}

void expect_at(const Sighting& s, std::size_t bound, double coordinate) {
  const auto axis = static_cast<Eigen::Index>(bound / 2);
  const double at = bound % 2 == 0 ? s.lower[axis] : s.upper[axis];
  const double sigma = bound % 2 == 0 ? s.lower_sigma[axis] : s.upper_sigma[axis];
  EXPECT_NEAR(at, coordinate, 3.0 * sigma) << "bound " << bound;
  EXPECT_LT(sigma, 0.1) << "bound " << bound;
}

TEST(Detector, SeesAllEndsOfABoxButTheOneThatItHidesItself) {
  for (const DepthSensor& sensor : {camera(), lidar()}) {
    const auto sightings = seen(sensor, {Box(Vec3(4, -0.4, 0.8), Vec3(5, 0.5, 1.6))});
    ASSERT_EQ(sightings.size(), 1u);
    const Sighting& s = sightings[0];
    EXPECT_THAT(s.bounds, ElementsAre(kFace, kUnseen, kWhole, kWhole, kWhole, kWhole));
    const std::array<double, 6> truth = {4.0, 5.0, -0.4, 0.5, 0.8, 1.6};
    for (const std::size_t b : {0u, 2u, 3u, 4u, 5u}) expect_at(s, b, truth[b]);
    EXPECT_LT(s.upper.x(), 4.5);
  }
}

TEST(Detector, FitsTheFacesThatMeetInACorner) {
  const Box box(Vec3(3, 1, 1.4), Vec3(4, 2, 2.2));
  for (const DepthSensor& sensor : {camera(), lidar()}) {
    const auto sightings = seen(sensor, {box});
    ASSERT_EQ(sightings.size(), 1u);
    EXPECT_EQ(sightings[0].bounds[0], kFace);
    EXPECT_EQ(sightings[0].bounds[2], kFace);
    EXPECT_EQ(sightings[0].bounds[4], kFace);
    for (const std::size_t b : {0u, 2u, 4u}) {
      expect_at(sightings[0], b, box.min()[static_cast<Eigen::Index>(b / 2)]);
    }
  }
}

TEST(Detector, TellsAHiddenEndFromAnEnd) {
  // A pillar hides the right half of a wall; their distance makes them two clusters.
  const auto sightings =
      seen(camera(), {Box(Vec3(3, -2.5, 0), Vec3(3.2, -0.3, 2)), Box(Vec3(6, -1.5, 0.5), Vec3(7, 1, 1.5))});
  ASSERT_EQ(sightings.size(), 2u);
  const Sighting& wall = sightings[0].lower.x() > 5.0 ? sightings[0] : sightings[1];
  EXPECT_EQ(wall.bounds[2], kOccluded);
  EXPECT_EQ(wall.bounds[3], kWhole);
  EXPECT_NEAR(wall.lower.y(), -0.6, 0.15);  // the pillar's shadow, where the wall is known to be
}

TEST(Detector, TellsTheEdgeOfThePictureFromAnEnd) {
  const auto sightings = seen(camera(), {Box(Vec3(3, -0.5, 0.7), Vec3(3.4, 6, 1.3))});
  ASSERT_EQ(sightings.size(), 1u);
  EXPECT_THAT(sightings[0].bounds, ElementsAre(kFace, kUnseen, kWhole, kCut, kWhole, kWhole));
}

TEST(Detector, TellsTheRangeFromAnEnd) {
  // A beam that leads away: its far end is beyond the camera's 10 m.
  const auto sightings = seen(camera(), {Box(Vec3(6, 1, 0.8), Vec3(14, 1.4, 1.2))});
  ASSERT_EQ(sightings.size(), 1u);
  EXPECT_NE(sightings[0].bounds[1], kWhole);
  EXPECT_NE(sightings[0].bounds[1], kFace);
}

TEST(Detector, RemovesGroundAndWallsAndFeelsTheirTouch) {
  const Box wall(Vec3(-2, 2, 0), Vec3(12, 2.2, 3));
  const std::vector<Box> known = {wall};
  const Box box(Vec3(4, -0.5, 0), Vec3(5, 0.5, 1.5));
  const auto sightings = seen(camera(), {box, wall}, {0.0, known});
  ASSERT_EQ(sightings.size(), 1u);
  EXPECT_THAT(sightings[0].bounds, ElementsAre(kFace, kUnseen, kWhole, kWhole, kTouching, kWhole));
  EXPECT_NEAR(sightings[0].lower.z(), 0.1, 0.15);
}

TEST(Detector, PeelsBoxesThatHangTogether) {
  // Seen as one cluster, since the step between them is less than 0.25 m + 2√2 σ.
  const Box near(Vec3(5.0, -0.9, 0.5), Vec3(5.8, -0.1, 1.5)), far(Vec3(5.3, -0.1, 0.5), Vec3(6.1, 0.9, 1.5));
  const auto sightings = seen(camera(), {near, far});
  ASSERT_EQ(sightings.size(), 2u);
  std::vector<double> faces = {sightings[0].lower.x(), sightings[1].lower.x()};
  std::ranges::sort(faces);
  EXPECT_NEAR(faces[0], 5.0, 0.03);
  EXPECT_NEAR(faces[1], 5.3, 0.03);
}

TEST(Detector, DependsOnThePictureAlone) {
  Scene first(camera()), second(lidar());
  first.render(kAhead, {Box(Vec3(4, -1, 0), Vec3(5, 0, 2)), Box(Vec3(7, 0.5, 0), Vec3(8, 2, 2))});
  second.render(kAhead, {Box(Vec3(2, -1, 0), Vec3(3, 0, 2))});
  const auto same = [](const Sighting& a, const Sighting& b) {
    return a.lower == b.lower && a.upper == b.upper && a.lower_sigma == b.lower_sigma && a.bounds == b.bounds;
  };
  Detector used;
  used.detect(second.picture, {});
  const auto again = used.detect(first.picture, {});
  const auto fresh = Detector().detect(first.picture, {});
  EXPECT_TRUE(std::ranges::equal(again, fresh, same));
}

TEST(Detector, FindsNothingInBrokenPictures) {
  DepthPicture picture(std::make_shared<RayGrid>(camera()));
  for (const float depth :
       {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    picture.depths().setConstant(depth);
    EXPECT_TRUE(Detector().detect(picture, {0.0, {}}).empty()) << depth;
  }
}

TEST(Detector, ReportsEachClusterOnceAndNothingSmall) {
  std::vector<Box> pillars;
  for (int k = -3; k <= 3; ++k) pillars.push_back(box_around(Vec3(6, k, 1), Vec3(0.15, 0.15, 0.6)));
  pillars.push_back(box_around(Vec3(8, 0.5, 2.6), Vec3::Constant(0.02)));
  EXPECT_EQ(seen(camera(), pillars).size(), 7u);
}

TEST(Detector, KeepsTheSightingsWithTheMostPixels) {
  DepthPicture picture(std::make_shared<RayGrid>(camera()));
  std::vector<Sighting> many(idx(kMaxSightings + 20));
  for (std::size_t k = 0; k < many.size(); ++k) many[k].points = static_cast<std::int32_t>(k + 1);
  const SightingSet set = frame_of(picture, many, UTime{5}, 3);
  EXPECT_EQ(set.sightings.size(), idx(kMaxSightings));
  EXPECT_EQ(set.left_out, 20);
  EXPECT_EQ(set.sightings.back().points, 21);
  EXPECT_EQ(set.sensor_id, 3);
}

}  // namespace
}  // namespace tern
