#include "executor/tube.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr Duration kBeat{10'000};
constexpr UTime kNow{1'000'000'000};

void blocked(Tube& tube, UTime at) {
  Plan plan;
  plan.outcome = PlanOutcome::KeepCommitted;
  plan.reason = PlanReason::GoalBlocked;
  tube.on_answer(plan, true, at);
}
void flown(Tube& tube, UTime at) {
  Plan plan;
  plan.outcome = PlanOutcome::Optimized;
  tube.on_answer(plan, false, at);
}

TEST(Tube, OfAPerfectVehicleIsNothing) {
  Tube tube(0.0);
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow), Vec3::Zero());
  for (int k = 0; k < 1000; ++k) tube.add(Vec3::Constant(1e-4), k % 2 == 0, UTime{k * kBeat.us});
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow), Vec3::Zero());
  blocked(tube, kNow);
  EXPECT_EQ(tube.share(), 1.0) << "a slower one would be no nearer to its setpoints";
}

TEST(Tube, OfAnyOtherBeginsWithWhatAWellTunedAutopilotNeeds) {
  Tube tube(0.0);
  tube.note_error(Vec3(0.0, 0.002, 0.0));
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow), Vec3::Constant(Tube::kMargin * Tube::kPriorError));
}

TEST(Tube, IsNeverUnderItsFloorNorOverTheWidest) {
  Tube tube(0.4);
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow), Vec3::Constant(0.4));
  tube.add(Vec3(0.1, 50.0, 0.0), false, UTime{1});
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow), Vec3(0.4, kMaxTube, 0.4));
}

TEST(Tube, CoversTheNextSecondMoreOftenThanTheQuantileAlone) {
  Rng rng(11);
  Tube tube(0.0);
  UTime at{1'000'000};
  int left = 0, promised = 0;
  for (int second = 0; second < 3000; ++second) {
    const double width = tube.width(Vec3::Zero(), kNow).x();
    double largest = 0.0;
    for (int k = 0; k < 100; ++k, at = at + kBeat) {
      const double error = 0.4 * std::abs(rng.normal());
      largest = std::max(largest, error);
      tube.add(Vec3(error, 0.0, 0.0), false, at);
    }
    if (second < 120) continue;
    ++promised;
    if (largest > width) ++left;
  }
  // Errors exceed the quantile in 2 % of the seconds; with the margin, in fewer than half of that.
  EXPECT_LT(left, 0.01 * promised) << left << " of " << promised;
}

TEST(Tube, AddsTheUncertaintyOfTheEstimate) {
  Tube tube(0.0);
  const Vec3 width = tube.width(Vec3(0.045, 0.0, 0.01), UTime{1});
  EXPECT_NEAR(width.x(), 0.15, 1e-12);
  EXPECT_EQ(width.y(), 0.0);
  EXPECT_NEAR(width.z(), 0.05, 1e-12);
}

TEST(Tube, IsWiderAfterAnEventForAWhile) {
  Tube tube(0.2);
  tube.add_exit(kNow);
  EXPECT_NEAR(tube.width(Vec3::Zero(), kNow).x(), 0.3, 1e-12);
  EXPECT_NEAR(tube.width(Vec3::Zero(), kNow + Tube::kWidenedFor).x(), 0.2, 1e-12);
}

/// A tube after errors of 0.3 m in flight and 0.03 m at rest.
Tube imperfect() {
  Tube tube(0.0);
  tube.add(Vec3::Constant(0.3), false, UTime{1});
  tube.add(Vec3::Constant(0.03), true, UTime{2});
  return tube;
}

TEST(Tube, IsHalvedWithTheLimitsWhereTheStartIsBlockedDownToWhatIsMeasuredAtRest) {
  Tube tube = imperfect();
  const double whole = tube.width(Vec3::Zero(), kNow).x();
  EXPECT_NEAR(whole, 0.45, 1e-12);
  UTime at = kNow;
  blocked(tube, at);
  EXPECT_NEAR(tube.width(Vec3::Zero(), kNow).x(), whole / 2.0, 1e-12);
  EXPECT_EQ(tube.share(), 0.5);
  blocked(tube, at + Tube::kStepPeriod - Duration{1});
  EXPECT_EQ(tube.share(), 0.5) << "a plan that fails twenty times a second is one reason";
  for (int k = 0; k < 10; ++k) blocked(tube, at = at + Tube::kStepPeriod);
  EXPECT_NEAR(tube.width(Vec3::Zero(), kNow).x(), Tube::kTubeStep, 1e-12);
  EXPECT_EQ(tube.share(), std::ldexp(1.0, -Tube::kMaxHalvings));
  for (int k = 0; k < Tube::kMaxHalvings; ++k) flown(tube, at = at + Tube::kMaxPatience);
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow).x(), whole);
  EXPECT_EQ(tube.share(), 1.0);
}

TEST(Tube, HalvesItsFloorWhereTheStartIsInCollisionAlone) {
  Tube tube(0.25);
  UTime at = kNow;
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow).x(), 0.25);
  Plan goal_blocked;
  goal_blocked.outcome = PlanOutcome::NoPlan;
  goal_blocked.reason = PlanReason::GoalBlocked;
  tube.on_answer(goal_blocked, true, at);
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow).x(), 0.25) << "the margin that was asked for";
  Plan start_in_collision = goal_blocked;
  start_in_collision.reason = PlanReason::StartInCollision;
  tube.on_answer(start_in_collision, true, at);
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow).x(), 0.125);
  flown(tube, at = at + Tube::kMaxPatience);
  EXPECT_EQ(tube.width(Vec3::Zero(), kNow).x(), 0.25);
}

TEST(Tube, FliesSlowlyForAsLongAsAnOpeningMayBeAheadAndLongerWhereThatWasTooShort) {
  Tube tube = imperfect();
  UTime at = kNow;
  blocked(tube, at);
  flown(tube, at + Tube::kPatience * 2 - Duration{1});
  EXPECT_EQ(tube.share(), 0.5);
  flown(tube, at = at + Tube::kPatience * 2);
  EXPECT_EQ(tube.share(), 1.0);
  blocked(tube, at = at + Tube::kStepPeriod);
  flown(tube, at + Tube::kPatience * 4 - Duration{1});
  EXPECT_EQ(tube.share(), 0.5) << "the step up was too soon: twice as long now";
  flown(tube, at = at + Tube::kPatience * 4);
  EXPECT_EQ(tube.share(), 1.0);
  blocked(tube, at = at + Tube::kMaxPatience);
  flown(tube, at + Tube::kPatience * 2);
  EXPECT_EQ(tube.share(), 1.0) << "that one lasted";
}

TEST(Tube, PromisesNoLessThanWasMeasuredSoSlowly) {
  Tube tube = imperfect();
  blocked(tube, kNow);
  tube.add(Vec3::Constant(0.28), false, kNow);
  EXPECT_NEAR(tube.width(Vec3::Zero(), kNow).x(), 0.45, 1e-12);
}

TEST(Tube, HoldsTheTruePlaceWhicheverSideOfAResetIsRight) {
  Tube tube(0.2);
  tube.add_shift(Vec3(0.5, -0.1, 0.0));
  EXPECT_LT((tube.width(Vec3::Zero(), kNow) - Vec3(0.7, 0.3, 0.2)).norm(), 1e-12);
  tube.add_shift(Vec3(-0.7, 0.0, 0.0));  // the sums are 0, 0.5 and -0.2
  EXPECT_LT((tube.width(Vec3::Zero(), kNow) - Vec3(0.9, 0.3, 0.2)).norm(), 1e-12);
  tube.add_shift(Vec3(0.2, 0.1, 0.0));
  EXPECT_LT((tube.width(Vec3::Zero(), kNow) - Vec3(0.7, 0.3, 0.2)).norm(), 1e-12) << "it may have been right before";
}

TEST(Tube, ForgetsTheErrorsOfACauseThatIsReportedToBeOver) {
  Tube tube = imperfect();
  const double before = tube.width(Vec3::Zero(), kNow).x();
  const auto errs = [&](UTime at) {
    tube.add(Vec3::Constant(0.9), false, at);
    tube.add_exit(at);
  };
  const UTime left = kNow + Tube::kSecond * 10;
  errs(left - Tube::kSecond);
  EXPECT_GT(tube.width(Vec3::Zero(), left).x(), 1.3);
  tube.forget_since(left - Tube::kSecond);
  EXPECT_EQ(tube.width(Vec3::Zero(), left).x(), before);
  errs(left + Tube::kSecond * 5);
  tube.forget_since(left + Tube::kSecond * 5);
  EXPECT_GT(tube.width(Vec3::Zero(), left + Tube::kSecond * 5).x(), 1.3) << "it comes back";
}

TEST(Tube, ForgetsAfterTwoMinutes) {
  Tube tube(0.0);
  tube.add(Vec3(1.0, 0.0, 0.0), false, UTime{1});
  EXPECT_GE(tube.width(Vec3::Zero(), kNow).x(), 1.0);
  for (int k = 1; k <= 121; ++k) tube.add(Vec3(0.01, 0.0, 0.0), false, UTime{1 + k * 1'000'000LL});
  EXPECT_NEAR(tube.width(Vec3::Zero(), kNow).x(), Tube::kTubeStep, 1e-12);
}

}  // namespace
}  // namespace tern
