#include "executor/rejoin_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

using testing::HasSubstr;

const Box kAllowed(Vec3(-3, -6, 0.3), Vec3(20, 6, 3.7));
const Vec3 kStart(0, 0, 1);
constexpr UTime kBegin{1'000'000};
UTime at(double s) { return kBegin + Duration::from_seconds(s); }

TEST(RejoinGuard, StartsInsideTheBoxAndNearTheStartOnly) {
  const RejoinGuard guard(kAllowed);
  EXPECT_FALSE(guard.check_start(kStart, kStart, false));
  EXPECT_FALSE(guard.check_start(Vec3(0, 0, 0.1), kStart, false)) << "it stands on the ground";
  EXPECT_FALSE(guard.check_start(Vec3(4, 0, 1), kStart, false));
  EXPECT_THAT(
      guard.check_start(Vec3(0, 0, -1), kStart, false).value_or(""),
      HasSubstr("the vehicle is at (0.00, 0.00, -1.00) m, outside uav.flight_box; uav.start is (0.00, 0.00, 1.00): "
                "are frame and unit of UAV_STATE right?"))
      << "NED";
  EXPECT_TRUE(guard.check_start(1000.0 * kStart, kStart, false)) << "millimetres";
  EXPECT_THAT(guard.check_start(Vec3(15, 0, 1), kStart, false).value_or(""), HasSubstr("15.0 m from uav.start"));
  EXPECT_FALSE(guard.check_start(Vec3(15, 0, 1), kStart, true)) << "the executor was restarted in flight";
  EXPECT_TRUE(guard.check_start(Vec3(15, 0, -1), kStart, true)) << "but in NED all the same";
  EXPECT_FALSE(RejoinGuard(kAllowed, 20.0).check_start(Vec3(15, 0, 1), kStart, false)) << "executor.start_reach_m";
}

TEST(RejoinGuard, AConstantOffsetEndsAfterThreeMetresWhateverItsSize) {
  for (const double step : {0.15, 0.5, 1.0, 2.0, 2.9}) {
    RejoinGuard guard(Box(Vec3::Constant(-1e4), Vec3::Constant(1e4)));
    Vec3 commanded = kStart;
    int rejoins = 0;
    for (double s = 0.0; rejoins < 1000; s += 0.05, ++rejoins) {
      const Vec3 measured = commanded + Vec3(0, step, 0);
      if (guard.check_rejoin(commanded, measured, true, at(s))) break;
      commanded = measured;
    }
    EXPECT_LE((commanded - kStart).norm(), RejoinGuard::kMaxShift + RejoinGuard::kForgiven * 0.05 * rejoins) << step;
  }
}

TEST(RejoinGuard, RareExitsOfAVehicleInWindEndNothing) {
  RejoinGuard guard(kAllowed);
  Rng rng(1);
  for (double s = 0.0; s < 3600.0; s += 20.0) {
    const Vec3 off(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(-0.2, 0.2));
    ASSERT_FALSE(guard.check_rejoin(kStart, kStart + off, true, at(s)));
  }
}

TEST(RejoinGuard, ShiftsThatAreNotTheEstimatesDoNotCount) {
  RejoinGuard guard(kAllowed);
  for (int k = 0; k < 100; ++k) ASSERT_FALSE(guard.check_rejoin(kStart, kStart + Vec3(1, 0, 0), false, at(0.1 * k)));
}

TEST(RejoinGuard, AnnouncedResetsCountAsRejoinsDo) {
  RejoinGuard guard(kAllowed);
  EXPECT_FALSE(guard.check_reset(Vec3(0, 1.4, 0), at(0)));
  EXPECT_FALSE(guard.check_rejoin(kStart, kStart + Vec3(0, 1.4, 0), true, at(0.1))) << "the same shift";
  EXPECT_FALSE(guard.check_rejoin(kStart, kStart + Vec3(0, 1.5, 0), true, at(5)));
  EXPECT_FALSE(guard.check_reset(Vec3(0, 1.5, 0), at(5.1))) << "the same shift, announced late";
  EXPECT_THAT(guard.check_reset(Vec3(0, 0.6, 0), at(6)).value_or(""),
              HasSubstr("the estimator has shifted the vehicle by 0.60 m, by 3."));
  EXPECT_TRUE(RejoinGuard(kAllowed).check_reset(Vec3(0, 0, 8.3), at(0))) << "one is enough if it is large";
}

TEST(RejoinGuard, TheFirstExcursionIsTheLast) {
  RejoinGuard guard(kAllowed);
  EXPECT_FALSE(guard.check_rejoin(kStart, Vec3(0, 6.5, 1), false, at(0))) << "within kMaxExcursion";
  guard.add_excursion(Box(Vec3(0, 6.5, 1), Vec3(0, 6.8, 1)));
  EXPECT_FALSE(guard.check_rejoin(kStart, Vec3(0, 7.0, 1), false, at(1)));
  EXPECT_TRUE(guard.may_command(Vec3(0, 7.0, 1)));
  guard.add_excursion(Box(Vec3(0, 7.0, 1), Vec3(0, 7.5, 1)));
  EXPECT_FALSE(guard.may_command(Vec3(0, 7.1, 1))) << "later excursions do not widen the bound";
  EXPECT_THAT(guard.check_rejoin(kStart, Vec3(0, 7.2, 1), false, at(2)).value_or(""),
              HasSubstr("too far outside uav.flight_box"));
  EXPECT_TRUE(guard.check_rejoin(kStart, Vec3(0, 0, 6.0), false, at(3))) << "on another side as well";
  EXPECT_FALSE(guard.check_rejoin(kStart, Vec3(0, 0, 4.1), false, at(4))) << "within kMinExcursion";
}

}  // namespace
}  // namespace tern
