#include "planner/semantics/information_map.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/base/random.h"
#include "planner/semantics/drift.h"

namespace tern {
namespace {

/// A map of 60 × 20 × 4 m in voxels of 0.5 m, with one box of one class.
VoxelMap map_with(const Box& box, VoxelLabel label, const std::string& name) {
  VoxelMap map;
  map.grid.origin = Vec3(0, -10, 0);
  map.grid.resolution = 0.5;
  map.grid.size = {120, 40, 8};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {"", name};
  for (std::int64_t i = 0; i < map.grid.voxels(); ++i) {
    if (!box.contains(map.grid.centre(map.grid.cell(i)))) continue;
    map.labels[static_cast<std::size_t>(i)] = label;
    map.classes[static_cast<std::size_t>(i)] = 1;
  }
  return map;
}

const Box kSmall(Vec3(20, -4, 0), Vec3(40, 4, 4));

TEST(SurfaceMap, HasWaterBelowARegionOfWaterAndSidesAroundATexture) {
  const SurfaceMap water(map_with(kSmall, VoxelLabel::Repulsive, "water"), {});
  EXPECT_FLOAT_EQ(water.at(30, 0).ground, 0.03f);
  EXPECT_FLOAT_EQ(water.at(30, 0).sides, 0.0f);
  EXPECT_FLOAT_EQ(water.at(30, 4.5).ground, 1.0f);
  EXPECT_FLOAT_EQ(water.at(-500, 4.5).ground, 1.0f);
  const SurfaceMap texture(map_with(kSmall, VoxelLabel::Attractive, "texture"), {});
  EXPECT_FLOAT_EQ(texture.at(30, 0).sides, 8.0f);
  EXPECT_FALSE(texture.at(30, 0).is_opaque);
  EXPECT_FLOAT_EQ(texture.at(30, 0).high, 4.0f);
}

TEST(SurfaceMap, TakesObstaclesAtRestFromWhereverTheyAre) {
  const SurfaceMap map = SurfaceMap(map_with(kSmall, VoxelLabel::Repulsive, "water"), {})
                             .with_obstacles({Box(Vec3(-31, 20, 0), Vec3(-30, 21, 2))});
  EXPECT_TRUE(map.at(-30.5, 20.5).is_opaque);
  EXPECT_FLOAT_EQ(map.at(-30.5, 20.5).sides, 4.0f);
  EXPECT_FLOAT_EQ(map.at(30, 0).ground, 0.03f);
  EXPECT_FALSE(map.at(-20, 20.5).is_opaque);
}

TEST(SurfaceMap, TakesOtherDensitiesButNoOtherSides) {
  const std::vector<Box> rock{Box(Vec3(10, -1, 0), Vec3(11, 1, 2))};
  const SurfaceMap water(map_with(kSmall, VoxelLabel::Repulsive, "water"), {});
  EXPECT_EQ(water.promised(), (SurfaceDensities{4.0, {1.0, 0.03}}));
  const SurfaceMap lilies = water.with_densities({2.0, {0.5, 3.0}}).with_obstacles(rock);
  EXPECT_FLOAT_EQ(lilies.at(30, 0).ground, 3.0f);
  EXPECT_FLOAT_EQ(lilies.at(30, 0).sides, 0.0f) << "its label promises none";
  EXPECT_FLOAT_EQ(lilies.at(30, 5).ground, 0.5f);
  EXPECT_FLOAT_EQ(lilies.at(-500, 5).ground, 0.5f);
  EXPECT_FLOAT_EQ(lilies.at(10.5, 0).sides, 2.0f);
  const SurfaceMap texture(map_with(kSmall, VoxelLabel::Attractive, "texture"), {});
  EXPECT_FLOAT_EQ(texture.with_densities({4.0, {1.0, 0.2}}).at(30, 0).sides, 0.2f);
}

TEST(LookAlong, SeesAsMuchGroundAsItsPartOfTheAnnulusHas) {
  const TextureCamera camera;
  const ViewInformation view = look_along({VoxelMap{}, {}}, Vec3(0, 0, 1), Eigen::Vector2d(0, 1), 0.25, camera);
  const double near = 1.0 / std::tan(camera.half_height_rad), far = 1.0 / std::tan(camera.grazing_rad);
  EXPECT_NEAR(view.landmarks, 0.5 * 0.25 * (far * far - near * near), 0.05 * view.landmarks);
}

TEST(LookAlong, SeesASideAndNothingBehindAnObstacle) {
  const TextureCamera camera;
  LandmarkPriors dark;
  dark.ground = 0.0;
  const Box wall(Vec3(40, -4, 0), Vec3(41, 4, 4));
  const SurfaceMap texture(map_with(wall, VoxelLabel::Attractive, "texture"), dark);
  const Vec3 eye(30, 0.1, 1);
  const double width = 0.1;
  const ViewInformation seen = look_along(texture, eye, Eigen::Vector2d(1, 0), width, camera);
  // Near and far side: 8 landmarks per m², 4 m high, as wide as the ray at 10 and 11 m.
  EXPECT_NEAR(seen.landmarks, 8.0 * 4.0 * width * (10.0 + 11.0), 0.06 * seen.landmarks);
  EXPECT_EQ(look_along(texture, eye, Eigen::Vector2d(-1, 0), width, camera).landmarks, 0.0);
  const SurfaceMap hidden = texture.with_obstacles({Box(Vec3(34, -1, 0), Vec3(35, 1, 4))});
  EXPECT_NEAR(look_along(hidden, eye, Eigen::Vector2d(1, 0), width, camera).landmarks, 4.0 * 4.0 * width * 4.0, 1.5);
}

/// The pixel and disparity of a landmark at x for a camera that looks along x, has moved by t and turned by θ.
Vec3 seen_by(const Vec3& x, const Vec3& theta, const Vec3& t, const TextureCamera& camera) {
  const Vec3 q = x + t + theta.cross(x);
  return Vec3(-q.y(), -q.z(), camera.baseline_m) * (camera.focal_px / q.x());
}

TEST(FrameSigma, IsThatOfThePixelsByFiniteDifferences) {
  const TextureCamera camera;
  Rng rng(3);
  for (int k = 0; k < 200; ++k) {
    ViewInformation view;
    Mat6 slow = Mat6::Zero();
    const int n = 12 + static_cast<int>(rng.uniform(0.0, 60.0));
    for (int i = 0; i < n; ++i) {
      const double bearing = rng.uniform(-0.7, 0.7), distance = rng.uniform(2.0, 20.0);
      const Vec3 x(distance * std::cos(bearing), distance * std::sin(bearing), rng.uniform(-0.4, 0.4) * distance);
      view.add(x, 1.0, camera);
      Eigen::Matrix<double, 3, 6> J;
      for (int j = 0; j < 6; ++j) {
        Eigen::Matrix<double, 6, 1> d = Eigen::Matrix<double, 6, 1>::Zero();
        d[j] = 1e-6;
        J.col(j) =
            (seen_by(x, d.head<3>(), d.tail<3>(), camera) - seen_by(x, -d.head<3>(), -d.tail<3>(), camera)) / 2e-6;
      }
      slow += J.transpose() * Vec3(0.5, 0.5, 0.25).asDiagonal() * J;
    }
    slow.diagonal().head<3>().array() += 1.0 / (kFlightNoise.rate * kFlightNoise.rate * camera.frame_s);
    const double expected = std::sqrt(slow.inverse().eval().bottomRightCorner<3, 3>().trace());
    // Off the axis a radian has more pixels, 1/cos² of them in one direction, and depth is less than distance: a pixel
    // says up to so much more than the rotation-invariant form assumes.
    const double corner = 1.0 / std::pow(std::cos(std::hypot(0.7, 0.4)), 2);
    const double ratio = frame_sigma(view, camera).translation_m / expected;
    EXPECT_GE(ratio, 0.97);
    EXPECT_LE(ratio, corner);
  }
}

TEST(InformationMap, SeesLessTheFartherFromTheShore) {
  const SurfaceMap surfaces(map_with(Box(Vec3(10, -8, 0), Vec3(50, 8, 4)), VoxelLabel::Repulsive, "water"), {});
  const InformationMap map(surfaces, Box(Vec3(0, -12, 0), Vec3(60, 12, 4)), {1.0});
  double last = 0.0;
  for (const double y : {12.0, 8.0, 6.0, 4.0, 2.0, 0.0}) {
    const double growth = static_cast<double>(map.sight({30, y, 1}, 1.0, 0.0).growth);
    EXPECT_GE(growth, last) << y;
    last = growth;
  }
  EXPECT_GT(last, 50.0 * static_cast<double>(map.sight({0, 0, 1}, -1.0, 0.0).growth));
  EXPECT_LT(map.sight({30, 6, 1}, 0.0, 1.0).growth, map.sight({30, 6, 1}, 0.0, -1.0).growth) << "towards the shore";
  EXPECT_EQ(map.sight({30, 6, 1}, 0.0, 0.0).growth, map.sight({30, 6, 1}, 6).growth) << "the best heading";
}

TEST(InformationMap, SeesFartherFromHigher) {
  const SurfaceMap surfaces(map_with(Box(Vec3(10, -8, 0), Vec3(50, 8, 4)), VoxelLabel::Repulsive, "water"), {});
  const InformationMap map(surfaces, Box(Vec3(0, -12, 0), Vec3(60, 12, 4)), {1.0, 4.0});
  EXPECT_LT(map.sight({30, 0, 4}, 1.0, 0.0).growth, 0.1f * map.sight({30, 0, 1}, 1.0, 0.0).growth);
}

}  // namespace
}  // namespace tern
