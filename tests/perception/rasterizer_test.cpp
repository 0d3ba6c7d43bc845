#include "perception/rasterizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

constexpr double kPi = std::numbers::pi;

DepthSensor camera() {
  DepthSensor sensor;
  sensor.shape = camera_shape(85.2 * kPi / 180.0, 58.0 * kPi / 180.0, 106, 72);
  return sensor;
}

DepthSensor lidar() {
  DepthSensor sensor;
  sensor.shape = lidar_shape(2.0 * kPi, -7.5 * kPi / 180.0, 52.5 * kPi / 180.0, 360, 60);
  sensor.range_m = 20.0;
  return sensor;
}

/// A narrow lidar that looks to one side does not wrap.
DepthSensor narrow_lidar() {
  DepthSensor sensor = lidar();
  sensor.shape = lidar_shape(1.5 * kPi, -0.4, 0.7, 90, 40);
  return sensor;
}

/// The depth at which a ray enters a box, by its definition and in double; infinity if it misses it.
double entry(const Vec3& ray, const Box& box, const Vec3& eye) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a) {
    if (ray[a] == 0.0) {
      if (eye[a] < box.min()[a] || eye[a] > box.max()[a]) return std::numeric_limits<double>::infinity();
      continue;
    }
    const double first = (box.min()[a] - eye[a]) / ray[a], second = (box.max()[a] - eye[a]) / ray[a];
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

std::vector<Box> random_boxes(Rng& rng, int count) {
  std::vector<Box> boxes;
  for (int k = 0; k < count; ++k) {
    const Vec3 centre(rng.uniform(-14, 14), rng.uniform(-14, 14), rng.uniform(-5, 6));
    boxes.push_back(box_around(centre, Vec3(rng.uniform(0.05, 2), rng.uniform(0.05, 5), rng.uniform(0.05, 3))));
  }
  return boxes;
}

SensorPose random_pose(Rng& rng) {
  const Vec3 axis(rng.normal(), rng.normal(), rng.normal());
  return {Vec3(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)),
          Eigen::Quaterniond(Eigen::AngleAxisd(rng.uniform(-kPi, kPi), axis.normalized()))};
}

/// Every pixel's depth lies between those of the scene with all boxes a little larger and a little smaller.
void expect_as_cast(const DepthPicture& picture, const std::vector<Box>& boxes, std::optional<double> ground_z) {
  constexpr double kRounding = 2e-5;
  const DepthSensor& sensor = picture.sensor();
  for (int pixel = 0; pixel < picture.shape().pixels(); ++pixel) {
    const Vec3 ray_C = sensor.shape.ray(pixel % sensor.shape.columns, pixel / sensor.shape.columns);
    const Vec3 ray = picture.pose().q_WC * ray_C;
    double least = sensor.range_m, most = sensor.range_m;
    for (const Box& box : boxes) {
      least = std::min(least, entry(ray, grown(box, Vec3::Constant(kRounding)), picture.pose().position));
      most = std::min(most, entry(ray, grown(box, Vec3::Constant(-kRounding)), picture.pose().position));
    }
    if (ground_z && ray.z() < 0.0) {
      const double depth = (*ground_z - picture.pose().position.z()) / ray.z();
      least = std::min(least, depth);
      most = std::min(most, depth);
    }
    const double depth = picture.depths()[pixel];
    const double slack = 1e-4;
    if (depth == kNotMeasured) {
      ASSERT_LT(least, sensor.least_range_m + slack) << pixel;
    } else {
      ASSERT_GE(depth, least - slack * (1 + least)) << pixel;
      ASSERT_LE(depth, most + slack * (1 + most)) << pixel;
    }
  }
}

TEST(Rasterizer, GivesTheNearestBoxThatARayMeets) {
  Rng rng(3);
  Rasterizer rasterizer;
  for (const DepthSensor& sensor : {camera(), lidar(), narrow_lidar()}) {
    const auto grid = std::make_shared<RayGrid>(sensor);
    DepthPicture picture(grid);
    for (int round = 0; round < support::at_effort(100); ++round) {
      const std::vector<Box> boxes = random_boxes(rng, 40);
      const SensorPose pose = round % 2 == 0 ? random_pose(rng) : looking(Vec3(0, 0, 1), rng.uniform(-kPi, kPi));
      const std::optional<double> ground = round % 3 == 0 ? std::optional(pose.position.z() - 1.5) : std::nullopt;
      rasterizer.begin(picture, pose);
      for (const Box& box : boxes) rasterizer.add(picture, box);
      if (ground) rasterizer.add_ground(picture, *ground);
      rasterizer.end(picture);
      expect_as_cast(picture, boxes, ground);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Rasterizer, MeasuresNothingInsideABoxOrBelowTheGround) {
  DepthPicture picture(std::make_shared<RayGrid>(camera()));
  Rasterizer rasterizer;
  rasterizer.begin(picture, looking(Vec3(0, 0, 1), 0.0));
  rasterizer.add(picture, box_around(Vec3(0, 0, 1), Vec3::Ones()));
  rasterizer.end(picture);
  EXPECT_TRUE((picture.depths() == kNotMeasured).all());
  rasterizer.begin(picture, looking(Vec3(0, 0, -1), 0.0));
  rasterizer.add_ground(picture, 0.0);
  rasterizer.end(picture);
  EXPECT_TRUE((picture.depths() == kNotMeasured).all());
}

TEST(DepthPicture, FindsThePixelOfEveryRay) {
  Rng rng(5);
  for (const DepthSensor& sensor : {camera(), lidar(), narrow_lidar()}) {
    DepthPicture picture(std::make_shared<RayGrid>(sensor));
    picture.move_to(random_pose(rng));
    for (int pixel = 0; pixel < sensor.shape.pixels(); ++pixel) {
      const float depth = static_cast<float>(rng.uniform(0.5, 9.0));
      const auto place = picture.place_of(picture.pose().position + picture.at_depth(pixel, depth).cast<double>());
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->u, pixel % sensor.shape.columns, 1e-3);
      EXPECT_NEAR(place->v, pixel / sensor.shape.columns, 1e-3);
      EXPECT_NEAR(place->depth, depth, 1e-4);
    }
  }
}

TEST(DepthPicture, LooksWhereItsPoseSays) {
  DepthPicture picture(std::make_shared<RayGrid>(camera()));
  picture.move_to(looking(Vec3(1, 2, 3), kPi / 2));  // along W's y
  const auto ahead = picture.place_of(Vec3(1, 7, 3));
  const auto right = picture.place_of(Vec3(2, 7, 3));
  const auto above = picture.place_of(Vec3(1, 7, 4));
  ASSERT_TRUE(ahead && right && above);
  EXPECT_NEAR(ahead->depth, 5.0, 1e-12);
  EXPECT_GT(right->u, ahead->u);
  EXPECT_LT(above->v, ahead->v);
  EXPECT_FALSE(picture.place_of(Vec3(1, -7, 3)));
}

TEST(DepthNoise, IsAFunctionOfSeedSensorAndFrame) {
  DepthSensor sensor = camera();
  sensor.noise = {0.0, 0.0025, 1};
  const auto noisy = [&](std::uint64_t seed, int number, std::int64_t frame) {
    DepthPicture picture(std::make_shared<RayGrid>(sensor));
    picture.depths().setConstant(5.0F);
    add_noise(picture, seed, number, frame);
    return Eigen::ArrayXf(picture.depths());
  };
  const Eigen::ArrayXf first = noisy(7, 0, 12);
  EXPECT_TRUE((first == noisy(7, 0, 12)).all());
  for (const Eigen::ArrayXf& other : {noisy(8, 0, 12), noisy(7, 1, 12), noisy(7, 0, 13)}) {
    EXPECT_LT((first == other).count(), 10);
    EXPECT_LT(std::abs(((first - 5.0F) * (other - 5.0F)).mean() / std::pow(0.0625F, 2.0F)), 0.05F);
  }
}

TEST(DepthNoise, HasItsStandardDeviationAndItsBlocks) {
  for (const int block : {1, 5}) {
    DepthSensor sensor = camera();
    sensor.noise = {0.01, 0.0025, block};
    DepthPicture picture(std::make_shared<RayGrid>(sensor));
    double square = 0.0, beside = 0.0;
    int count = 0;
    for (int frame = 0; frame < 50; ++frame) {
      picture.depths().setConstant(6.0F);
      add_noise(picture, 1, 0, frame);
      for (int pixel = 0; pixel + 1 < picture.shape().pixels(); ++pixel, ++count) {
        const double error = picture.depths()[pixel] - 6.0;
        square += error * error;
        beside += error * (picture.depths()[pixel + 1] - 6.0);
      }
    }
    EXPECT_NEAR(std::sqrt(square / count), 0.01 + 0.0025 * 36, 0.002);
    EXPECT_NEAR(beside / square, block == 1 ? 0.0 : 0.8, 0.02);  // four of five neighbours share a block
  }
}

TEST(DepthNoise, LeavesOutWhatItMovesBeyondTheRange) {
  DepthSensor sensor = camera();
  sensor.noise = {0.5, 0.0, 1};
  DepthPicture picture(std::make_shared<RayGrid>(sensor));
  picture.depths().setConstant(9.9F);
  picture.depths().head(100).setConstant(0.3F);
  add_noise(picture, 1, 0, 0);
  EXPECT_GT((picture.depths() >= picture.range()).count(), 1000);
  EXPECT_LE(picture.depths().maxCoeff(), picture.range());
  EXPECT_GT((picture.depths().head(100) == kNotMeasured).count(), 20);
}

}  // namespace
}  // namespace tern
