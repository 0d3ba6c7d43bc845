#include "core/scenario/step_aside.h"

#include <gtest/gtest.h>

#include <variant>

namespace tern {
namespace {

constexpr std::uint64_t kSeeds = 500;
constexpr double kStep = 0.002;  // s

bool touches(const ObstacleSpec& mover, const Vec3& p, double radius, double t) {
  const Vec3 centre = mover.centre + std::get<LinearMotion>(mover.motion).velocity * t;
  return ((p - centre).cwiseAbs().array() <= mover.half_extents.array() + radius).all();
}

TEST(StepAside, EveryMoverTouchesAVehicleThatStaysButNoneBeforeTheQuietTime) {
  const Vec3 start(1, -2, 50);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const StepAside drawn = draw_step_aside(seed, start);
    for (const ObstacleSpec& mover : drawn.movers) {
      double first = -1.0;
      for (double t = 0.0; t <= kStepAsideQuiet + 4.0 + 2.0 * kStep && first < 0.0; t += kStep) {
        if (touches(mover, start, drawn.body.radius, t)) first = t;
      }
      EXPECT_GE(first, kStepAsideQuiet - kStep) << "seed " << seed;
    }
  }
}

TEST(StepAside, DrawsOneToFiveMoversSomeOfThemFasterThanTheVehicle) {
  int counts[6] = {};
  int faster = 0;
  int unlimited_jerk = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const StepAside drawn = draw_step_aside(seed, Vec3::Zero());
    ASSERT_GE(drawn.movers.size(), 1U);
    ASSERT_LE(drawn.movers.size(), 5U);
    ++counts[drawn.movers.size()];
    for (const ObstacleSpec& mover : drawn.movers) {
      faster += std::get<LinearMotion>(mover.motion).velocity.norm() > drawn.limits.v_max.x() ? 1 : 0;
    }
    unlimited_jerk += std::isinf(drawn.limits.j_max.x()) ? 1 : 0;
  }
  for (int n = 1; n <= 5; ++n) EXPECT_GT(counts[n], 0) << n;
  EXPECT_GT(faster, 100);
  EXPECT_GT(unlimited_jerk, 50);
}

}  // namespace
}  // namespace tern
