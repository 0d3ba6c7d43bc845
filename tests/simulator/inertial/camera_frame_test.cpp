#include "simulator/inertial/camera_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace tern {
namespace {

Vec3 drawn(Rng& rng, double size) {
  const double x = rng.uniform(-size, size), y = rng.uniform(-size, size), z = rng.uniform(-size, size);
  return {x, y, z};
}

/// At (0, 0, 1), looking along W's x axis, at rest.
CameraFrame ahead(const std::vector<Box>& boxes = {}, const StereoSpec& spec = {}) {
  InertialState body;
  body.p = Vec3(0.0, 0.0, 1.0);
  return {spec, body, Vec3::Zero(), boxes};
}

SurfacePoint facing(const Vec3& p) { return {.p = p, .normal = Vec3(-1.0, 0.0, 0.0)}; }

TEST(CameraFrame, ProjectsByThePinholeModel) {
  const StereoSpec spec;
  const auto pixel = ahead().project(Vec3(10.0, 2.0, 1.5));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->left.x(), 424.0 - spec.focal_px() * 0.2, 1e-9);   // to the left: smaller u
  EXPECT_NEAR(pixel->left.y(), 240.0 - spec.focal_px() * 0.05, 1e-9);  // upwards: smaller v
  EXPECT_NEAR(pixel->disparity, spec.focal_px() * 0.11 / 10.0, 1e-9);
  EXPECT_NEAR(spec.focal_px(), 424.0 / std::tan(42.5 * M_PI / 180.0), 1e-9);
  EXPECT_FALSE(ahead().project(Vec3(-10.0, 0.0, 1.0)));
  EXPECT_FALSE(ahead().project(Vec3(1.0, 1.0, 1.0)));
}

TEST(CameraFrame, PitchDownLowersTheView) {
  StereoSpec down;
  down.pitch_down_deg = 30.0;
  const Vec3 below = Vec3(0.0, 0.0, 1.0) + 3.0 * Vec3(std::cos(M_PI / 6), 0.0, -std::sin(M_PI / 6));
  const auto pixel = ahead({}, down).project(below);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR((pixel->left - Eigen::Vector2d(424.0, 240.0)).norm(), 0.0, 1e-9);
}

TEST(CameraFrame, SeesByRangeAndGrazingAngle) {
  EXPECT_TRUE(ahead().see(facing(Vec3(24.9, 0.0, 1.0))));
  EXPECT_FALSE(ahead().see(facing(Vec3(25.1, 0.0, 1.0))));
  EXPECT_FALSE(ahead().see({.p = Vec3(5.0, 0.0, 1.0), .normal = Vec3(1.0, 0.0, 0.0)})) << "the back of a surface";
  EXPECT_TRUE(ahead().see({.p = Vec3(5.0, 0.0, 1.0), .normal = Vec3(1.0, 0.0, 0.0), .two_sided = true}));
  const double limit = 1.0 / std::tan(8.0 * M_PI / 180.0);  // 7.1 m from a height of 1 m
  EXPECT_TRUE(ahead().see({.p = Vec3(limit - 0.01, 0.0, 0.0), .normal = Vec3::UnitZ()}));
  EXPECT_FALSE(ahead().see({.p = Vec3(limit + 0.01, 0.0, 0.0), .normal = Vec3::UnitZ()}));
  EXPECT_TRUE(ahead().see({.p = Vec3(5000.0, 0.0, 1.0), .far = true}));
}

TEST(CameraFrame, HidesExactlyWhatABoxIsBefore) {
  Rng rng(4);
  int hidden = 0;
  for (int k = 0; k < 3000; ++k) {
    std::vector<Box> boxes;
    for (int b = 0; b < 3; ++b) {
      const Vec3 centre = Vec3(8.0, 0.0, 1.0) + drawn(rng, 6.0);
      boxes.push_back(box_around(centre, Vec3::Constant(1.0) + drawn(rng, 0.8)));
    }
    const CameraFrame frame = ahead(boxes);
    const Vec3 p = Vec3(9.0, 0.0, 1.0) + drawn(rng, 8.0);
    constexpr int kPoints = 4000;
    const auto at = [&](int i, double grow) {
      const Vec3 x = frame.eye() + (p - frame.eye()) * (static_cast<double>(i) / kPoints);
      return std::any_of(boxes.begin(), boxes.end(),
                         [&](const Box& b) { return grown(b, Vec3::Constant(grow)).contains(x); });
    };
    bool surely = false, maybe = false;
    for (int i = 0; i < kPoints - 5; ++i) {
      surely = surely || at(i, 0.0);
      maybe = maybe || at(i, 5e-3);  // more than half the distance of two points
    }
    const bool hides = frame.hides({.p = p});
    EXPECT_TRUE(!surely || hides) << k;
    EXPECT_TRUE(maybe || at(kPoints, 5e-3) || !hides) << k;
    hidden += hides ? 1 : 0;
  }
  EXPECT_GT(hidden, 100);
}

TEST(CameraFrame, ABoxDoesNotHideItsOwnFront) {
  const Box box = box_around(Vec3(5.0, 0.5, 1.0), Vec3::Constant(0.4));
  const CameraFrame frame = ahead({box});
  EXPECT_FALSE(frame.hides(facing(Vec3(4.6, 0.3, 1.1))));
  EXPECT_TRUE(frame.hides(facing(Vec3(5.4, 0.5, 1.0))));
}

/// The blur limit is compared with the true speed in the image, by differences of two exposures 10 µs apart.
TEST(CameraFrame, BlurIsTheSpeedInTheImage) {
  Rng rng(5);
  int tried = 0;
  while (tried < 300) {
    InertialState body{rotation_exp(drawn(rng, 0.8)), drawn(rng, 1.0), drawn(rng, 8.0)};
    const Vec3 rate = drawn(rng, 5.0);
    const Vec3 p = body.p + body.R * Vec3(rng.uniform(1.0, 12.0), rng.uniform(-5.0, 5.0), rng.uniform(-3.0, 3.0));
    const SurfacePoint point{.p = p, .v = drawn(rng, 3.0)};
    StereoSpec spec;
    spec.blur_px_s = 1e5;
    const auto now = CameraFrame(spec, body, rate, {}).project(p);
    constexpr double kApart = 1e-5;
    InertialState later = body;
    later.p += kApart * body.v;
    later.R = body.R * rotation_exp(kApart * rate);
    const auto then = CameraFrame(spec, later, rate, {}).project(p + kApart * point.v);
    if (!now || !then) continue;
    ++tried;
    const double speed = (then->left - now->left).norm() / kApart;
    spec.blur_px_s = 1.01 * speed + 0.1;
    EXPECT_TRUE(CameraFrame(spec, body, rate, {}).see(point));
    spec.blur_px_s = 0.99 * speed - 0.1;
    EXPECT_FALSE(CameraFrame(spec, body, rate, {}).see(point));
  }
}

}  // namespace
}  // namespace tern
