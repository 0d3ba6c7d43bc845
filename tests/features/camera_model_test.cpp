// Directions, pixels and back; the rectified pair.
#include "features/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "features/stereo_rig.h"
#include "tests/support/rendered_scene.h"

namespace tern {
namespace {

using Eigen::Vector2d;

TEST(CameraModel, GivesThePixelsOfItsEquations) {
  CameraModel camera{
      640, 480, 400.0, 410.0, 320.0, 240.0, LensModel::RadialTangential, {-0.3, 0.1, 0.001, -0.002, 0.01}};
  // x = 0.5, y = −0.25: r² = 0.3125.
  const double radial = 1.0 - 0.3 * 0.3125 + 0.1 * 0.3125 * 0.3125 + 0.01 * 0.3125 * 0.3125 * 0.3125;
  const double x = 0.5 * radial + 2.0 * 0.001 * (-0.125) - 0.002 * (0.3125 + 0.5);
  const double y = -0.25 * radial + 0.001 * (0.3125 + 0.125) - 2.0 * 0.002 * (-0.125);
  const auto pixel = camera.pixel_of(Vec3(1.0, -0.5, 2.0));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 400.0 * x + 320.0, 1e-9);
  EXPECT_NEAR(pixel->y(), 410.0 * y + 240.0, 1e-9);

  camera.lens = LensModel::Equidistant;
  camera.coefficients = {0.1, -0.02, 0.003, -0.0004, 0.0};
  const double theta = std::atan(0.75);
  const double bent = theta * (1.0 + 0.1 * std::pow(theta, 2) - 0.02 * std::pow(theta, 4) + 0.003 * std::pow(theta, 6) -
                               0.0004 * std::pow(theta, 8));
  const auto fisheye = camera.pixel_of(Vec3(0.75, 0.0, 1.0));
  ASSERT_TRUE(fisheye);
  EXPECT_NEAR(fisheye->x(), 400.0 * bent + 320.0, 1e-9);
  EXPECT_NEAR(fisheye->y(), 240.0, 1e-9);
}

TEST(CameraModel, EveryPixelOfAnImageComesBack) {
  Rng random(1);
  for (const auto& rig : {*support::euroc_like_rig(), *support::fisheye_rig()}) {
    for (const CameraModel& camera : {rig.left().model, rig.right().model}) {
      for (int k = 0; k < 10'000; ++k) {
        const Vector2d pixel(random.uniform(0.08, 0.92) * camera.width, random.uniform(0.08, 0.92) * camera.height);
        const auto at = camera.coordinates_of(pixel);
        ASSERT_TRUE(at) << pixel.transpose();
        const auto back = camera.pixel_of(Vec3(at->x(), at->y(), 1.0));
        ASSERT_TRUE(back);
        EXPECT_LT((*back - pixel).norm(), 1e-5);
      }
    }
  }
}

TEST(CameraModel, RefusesWhatTheLensDoesNotShow) {
  CameraModel camera = support::euroc_like_rig()->left().model;
  camera.coefficients = {-0.4, 0.0, 0.0, 0.0, 0.0};  // folds back at r = 0.91
  EXPECT_FALSE(camera.pixel_of(Vec3(0.1, 0.1, -1.0)));
  EXPECT_FALSE(camera.pixel_of(Vec3(1.0, 0.0, 0.0)));
  EXPECT_TRUE(camera.pixel_of(Vec3(0.9, 0.0, 1.0)));
  EXPECT_FALSE(camera.pixel_of(Vec3(1.0, 0.0, 1.0)));
  EXPECT_FALSE(camera.coordinates_of({5000.0, 5000.0}));
  const CameraModel fisheye = support::fisheye_rig()->left().model;
  EXPECT_FALSE(fisheye.coordinates_of({372.0 + 290.0 * 1.6, 241.0})) << "beyond 86°";
}

TEST(StereoRig, APointHasTheSameLineInBothImages) {
  Rng random(2);
  for (const auto& rig : {*support::euroc_like_rig(), *support::fisheye_rig()}) {
    EXPECT_NEAR(rig.baseline(), 0.11, 1e-3);
    for (int k = 0; k < 1000; ++k) {
      const double z = random.uniform(0.5, 20.0);
      const Vec3 x_C(random.uniform(-0.5, 0.5) * z, random.uniform(-0.4, 0.4) * z, z);
      const Vec3 p_B = rig.left().p_BC + rig.R_BC() * x_C;
      const auto pixel_in = [&](const MountedCamera& camera) {
        return *camera.model.pixel_of(camera.R_BC.transpose() * (p_B - camera.p_BC));
      };
      const auto left = rig.left_coordinates(pixel_in(rig.left()));
      const auto right = rig.right_coordinates(pixel_in(rig.right()));
      ASSERT_TRUE(left && right);
      EXPECT_LT((*left - x_C.head<2>() / z).norm(), 1e-8);
      EXPECT_LT((*right - (x_C - Vec3(rig.baseline(), 0.0, 0.0)).head<2>() / z).norm(), 1e-8);
      EXPECT_LT((*rig.right_pixel(*right) - pixel_in(rig.right())).norm(), 1e-5);
    }
  }
}

TEST(StereoRig, RefusesExchangedCamerasAndDivergingAxes) {
  const StereoRig rig = *support::euroc_like_rig();
  const auto exchanged = StereoRig::make(rig.right(), rig.left());
  ASSERT_FALSE(exchanged);
  EXPECT_NE(exchanged.error().message.find("exchanged"), std::string::npos);
  EXPECT_FALSE(StereoRig::make(rig.left(), rig.left()));
  MountedCamera aside = rig.right();
  aside.R_BC = Eigen::AngleAxisd(1.0, Vec3::UnitY()).toRotationMatrix() * aside.R_BC;
  EXPECT_FALSE(StereoRig::make(rig.left(), aside));
}

}  // namespace
}  // namespace tern
