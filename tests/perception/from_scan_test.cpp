#include "perception/from_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "perception/detector.h"
#include "tests/perception/scene.h"

namespace tern {
namespace {

using support::Scene;
using ::testing::HasSubstr;

const Box kBox(Vec3(4, -0.5, 0.6), Vec3(5, 0.7, 1.6));

/// A camera of 640 × 480 pixels in front of the box, as two messages.
std::vector<DepthImage> image(const SensorPose& pose) {
  DepthSensor sensor;
  sensor.shape = camera_shape(1.2, 0.95, 640, 480);
  Scene scene(sensor);
  scene.render(pose, {kBox});
  return support::depth_images(scene.picture, 200);
}

void expect_the_box(const DepthPicture& picture, double tolerance) {
  const auto sightings = Detector().detect(picture, {});
  ASSERT_EQ(sightings.size(), 1u);
  EXPECT_EQ(sightings[0].bounds[0], BoundSight::Face);
  EXPECT_NEAR(sightings[0].lower.x(), kBox.min().x(), tolerance);
  for (const int axis : {1, 2}) {
    EXPECT_EQ(sightings[0].bounds[idx(2 * axis)], BoundSight::Whole);
    EXPECT_EQ(sightings[0].bounds[idx(2 * axis + 1)], BoundSight::Whole);
    EXPECT_NEAR(sightings[0].lower[axis], kBox.min()[axis], 0.06);
    EXPECT_NEAR(sightings[0].upper[axis], kBox.max()[axis], 0.06);
  }
}

TEST(FromScan, MakesAPictureOfADepthImage) {
  const SensorPose pose = looking(Vec3(0, 0, 1), 0.1, -0.05);
  const auto picture = picture_of(image(pose), 480, {0.003, 0.0, 1}, 0.2);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->shape().columns, 160);
  EXPECT_EQ(picture->shape().rows, 120);
  expect_the_box(*picture, 0.02);
}

TEST(FromScan, CountsMissingRowsAsNotMeasured) {
  std::vector<DepthImage> parts = image(looking(Vec3(0, 0, 1), 0.0));
  parts.pop_back();
  const auto picture = picture_of(parts, 480, {0.003, 0.0, 1}, 0.2);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->depths()[160 * 119], kNotMeasured);
  EXPECT_GT(picture->depths()[0], 0.0F);
}

TEST(FromScan, MakesAPictureOfAPointCloud) {
  DepthSensor sensor = support::lidar();
  sensor.shape = lidar_shape(360.0 * support::kDegree, -30.0 * support::kDegree, 30.0 * support::kDegree, 720, 120);
  sensor.noise = {};
  Scene scene(sensor);
  scene.render(looking(Vec3(0, 0, 1), 0.4), {kBox});
  CloudScan scan;
  scan.range_m = 20.0;
  scan.sensor_position = Vec3(0, 0, 1);
  for (int pixel = 0; pixel < sensor.shape.pixels(); ++pixel) {
    CloudPoint point;
    point.position = scene.picture.at_depth(pixel, scene.picture.depths()[pixel]);
    if (!scene.picture.is_surface(pixel)) point.position.setConstant(std::nanf(""));
    scan.points.push_back(point);
  }
  const auto picture = picture_of(std::vector{scan}, {0.01, 0.0, 1}, 0.2);
  ASSERT_TRUE(picture) << picture.error().message;
  const auto sightings = Detector().detect(*picture, {});
  ASSERT_EQ(sightings.size(), 1u);
  EXPECT_EQ(sightings[0].bounds[0], BoundSight::Face);
  EXPECT_NEAR(sightings[0].lower.x(), 4.0, 0.03);
  EXPECT_NEAR(sightings[0].lower.y(), -0.5, 0.1);
  EXPECT_NEAR(sightings[0].upper.z(), 1.6, 0.1);
}

TEST(FromScan, NamesTheTroubleOfAnImage) {
  const SensorPose pose = looking(Vec3(0, 0, 1), 0.0);
  EXPECT_THAT(picture_of(std::vector<DepthImage>{}, 480, {}, 0.2).error().message, HasSubstr("no message"));
  EXPECT_THAT(picture_of(image(pose), 300, {}, 0.2).error().message, HasSubstr("do not fit into 300 rows"));
  std::vector<DepthImage> other = image(pose);
  other[1].fx += 1.0;
  EXPECT_THAT(picture_of(other, 480, {}, 0.2).error().message, HasSubstr("of another image or camera"));
  std::vector<DepthImage> zeros = image(pose);
  for (DepthImage& part : zeros) part.depths.assign(part.depths.size(), 0);
  EXPECT_THAT(picture_of(zeros, 480, {}, 0.2).error().message, HasSubstr("no pixel measured a depth"));
}

TEST(FromScan, NamesTheTroubleOfACloud) {
  EXPECT_THAT(picture_of(std::vector<CloudScan>{}, {}, 0.2).error().message, HasSubstr("no message"));
  CloudScan scan;
  scan.points.resize(3);
  for (CloudPoint& point : scan.points) point.position.setConstant(std::nanf(""));
  EXPECT_THAT(picture_of(std::vector{scan}, {}, 0.2).error().message, HasSubstr("no point was measured"));
  CloudScan later = scan;
  later.at = UTime{7};
  EXPECT_THAT(picture_of(std::vector{scan, later}, {}, 0.2).error().message, HasSubstr("of another scan"));
}

}  // namespace
}  // namespace tern
