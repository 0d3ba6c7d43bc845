#include "perception/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "tests/perception/scene.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

using support::camera;
using support::kDegree;
using support::lidar;
using support::Scene;

DepthSensor odd_lidar() {
  DepthSensor sensor = lidar();
  sensor.shape = lidar_shape(200.0 * kDegree, -20.0 * kDegree, 31.0 * kDegree, 211, 53);
  return sensor;
}

Vec3 random_point(Rng& rng, const Vec3& eye) {
  return eye + Vec3(rng.uniform(-15, 15), rng.uniform(-15, 15), rng.uniform(-6, 6));
}

/// A point that was looked through lies in front of everything that its cell shows. So it lies in no box, except in a
/// part that fits between two rays: around a point deeper in the box than half the diagonal of a pixel, a ray hits it.
TEST(View, NeverLooksThroughABox) {
  Rng rng(3);
  int through = 0, blocked = 0;
  for (const DepthSensor& sensor : {camera(), camera(5), lidar(), odd_lidar()}) {
    Scene scene(sensor);
    for (int round = 0; round < support::at_effort(100); ++round) {
      std::vector<Box> boxes;
      for (int k = 0; k < 20; ++k) {
        boxes.push_back(
            box_around(random_point(rng, Vec3(0, 0, 1)), Vec3(rng.uniform(0.3, 1), rng.uniform(0.3, 3), 1)));
      }
      scene.render(looking(Vec3(0, 0, 1), rng.uniform(-3, 3), rng.uniform(-0.5, 0.5)), boxes, {}, round);
      const SensorView view = view_of(scene.picture);
      ASSERT_LE(view.rows * view.columns, kMaxViewCells);
      ASSERT_EQ(view.depths.size(), idx(view.rows * view.columns));
      for (int k = 0; k < 300; ++k) {
        const Vec3 p = random_point(rng, Vec3(0, 0, 1));
        const Looked looked = looked_at(view, p);
        through += looked == Looked::Through ? 1 : 0;
        blocked += looked == Looked::Blocked ? 1 : 0;
        if (looked != Looked::Through) continue;
        const double between_rays = 0.5 * std::numbers::sqrt2 * sensor.shape.pixel_size() * place_in(view, p).depth;
        // Noise may move a surface by more than 3σ + 0.15 m: not in these pictures.
        for (const Box& box : boxes) {
          const Vec3 inside = (p - box.min()).cwiseMin(box.max() - p);
          ASSERT_LT(inside.minCoeff(), between_rays) << p.transpose();
        }
      }
    }
  }
  EXPECT_GT(through, 100);
  EXPECT_GT(blocked, 100);
}

TEST(View, HasTheSmallestDepthOfEachCellInThePlaceOfItsPixels) {
  Rng rng(4);
  for (const DepthSensor& sensor : {camera(), lidar(), odd_lidar()}) {
    DepthPicture picture(std::make_shared<RayGrid>(sensor));
    picture.move_to(looking(Vec3(1, 2, 3), 0.7, 0.2));
    for (float& depth : picture.depths()) {
      depth = static_cast<float>(rng.uniform() < 0.3 ? sensor.range_m : rng.uniform(0.5, 9.0));
    }
    const SensorView view = view_of(picture);
    std::vector<double> least(view.depths.size(), 1e9);
    for (int pixel = 0; pixel < picture.shape().pixels(); ++pixel) {
      const ViewPlace place = place_in(view, picture.pose().position + picture.at_depth(pixel, 2.0F).cast<double>());
      if (place.cell < 0) continue;  // beyond the last whole cell
      EXPECT_NEAR(place.depth, 2.0, 1e-5);
      least[idx(place.cell)] = std::min(least[idx(place.cell)], static_cast<double>(picture.depths()[pixel]));
    }
    for (int cell = 0; cell < view.rows * view.columns; ++cell) {
      const double expected = least[idx(cell)];
      if (expected >= sensor.range_m) {
        EXPECT_TRUE(std::isinf(cell_depth(view, cell)));
      } else {
        EXPECT_NEAR(cell_depth(view, cell), expected, view.unit_m);
        EXPECT_LE(cell_depth(view, cell), expected + 1e-6);
      }
    }
  }
}

TEST(View, IsBlindWhereThePictureMeasuredNothing) {
  DepthPicture picture(std::make_shared<RayGrid>(camera()));
  picture.move_to(looking(Vec3::Zero(), 0.0));
  EXPECT_EQ(looked_at(view_of(picture), Vec3(5, 0, 0)), Looked::Through);
  EXPECT_EQ(looked_at(view_of(picture), Vec3(-5, 0, 0)), Looked::OutOfView);
  EXPECT_EQ(looked_at(view_of(picture), Vec3(11, 0, 0)), Looked::OutOfView);
  picture.depths().setConstant(kNotMeasured);
  EXPECT_EQ(looked_at(view_of(picture), Vec3(5, 0, 0)), Looked::OutOfView);
  picture.depths().setConstant(3.0F);
  EXPECT_EQ(looked_at(view_of(picture), Vec3(5, 0, 0)), Looked::Blocked);
  EXPECT_EQ(looked_at(view_of(picture), Vec3(2, 0, 0)), Looked::Through);
  EXPECT_EQ(looked_at(view_of(picture), Vec3(2.9, 0, 0)), Looked::Blocked);
}

}  // namespace
}  // namespace tern
