#include "executor/estimate_resets.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

constexpr UTime kNow{1'000'000'000};

/// Flies along y at 5 m/s; from `jump` on its position is shifted by `by`.
UavState state_at(Duration since, Duration jump, const Vec3& by) {
  UavState state;
  state.at = kNow + since;
  state.motion.v = Vec3(0, 5, 0);
  state.motion.p = state.motion.v * since.seconds();
  if (since >= jump) state.motion.p += by;
  return state;
}

/// The shifts that are found if the reset is reported at `told`.
std::vector<Vec3> found(Duration jump, Duration told, const Vec3& by) {
  EstimateResets resets;
  std::vector<Vec3> shifts;
  resets.add(3, kNow);
  for (Duration since; since < Duration{2'000'000}; since = since + Duration{10'000}) {
    if (const auto shift = resets.add(state_at(since, jump, by), kNow + since)) shifts.push_back(*shift);
    if (const auto shift = resets.add(since >= told ? 4 : 3, kNow + since)) shifts.push_back(*shift);
  }
  return shifts;
}

TEST(EstimateResets, AreFoundWhicheverIsHeardFirst) {
  const Vec3 by(0.4, -0.3, 0.0);
  for (const std::int64_t told_us : {800'000, 950'000, 1'000'000, 1'100'000, 1'290'000}) {
    const std::vector<Vec3> shifts = found(Duration{1'000'000}, Duration{told_us}, by);
    ASSERT_EQ(shifts.size(), 1U) << told_us;
    EXPECT_LT((shifts[0] - by).norm(), 1e-9);
  }
}

TEST(EstimateResets, AreNoneWithoutAJumpOrWithoutAWord) {
  EXPECT_TRUE(found(Duration{1'000'000}, Duration{1'400'000}, Vec3(0.4, 0, 0)).empty()) << "too long ago";
  EXPECT_TRUE(found(Duration{1'000'000}, Duration{3'000'000}, Vec3(0.4, 0, 0)).empty()) << "a vehicle that is moved";
  EXPECT_TRUE(found(Duration{1'000'000}, Duration{1'000'000}, Vec3(0.04, 0, 0)).empty()) << "of the heading alone";
}

TEST(EstimateResets, AnOutlierThatTheNextStateTakesBackIsNone) {
  for (const std::int64_t told_us : {950'000, 1'000'000, 1'020'000}) {
    const Duration ahead{told_us == 950'000 ? -40'000 : told_us == 1'000'000 ? 40'000 : 0};  // a wrong stamp as well
    EstimateResets resets;
    resets.add(3, kNow);
    for (Duration since; since < Duration{2'000'000}; since = since + Duration{10'000}) {
      UavState state = state_at(since, Duration{5'000'000}, Vec3::Zero());
      if (since == Duration{1'000'000}) {
        state.motion.p.z() += 1.0;
        state.at = state.at + ahead;
      }
      EXPECT_FALSE(resets.add(state, kNow + since));
      EXPECT_FALSE(resets.add(since >= Duration{told_us} ? 4 : 3, kNow + since)) << told_us;
    }
  }
}

TEST(EstimateResets, AHoleInTheStatesIsNoJump) {
  EstimateResets resets;
  resets.add(0, kNow);
  resets.add(state_at({}, Duration{1'000}, Vec3(0.4, 0, 0)), kNow);
  EXPECT_FALSE(resets.add(1, kNow + Duration{200'000}));
  EXPECT_FALSE(resets.add(state_at(Duration{200'000}, Duration{1'000}, Vec3(0.4, 0, 0)), kNow + Duration{200'000}));
}

}  // namespace
}  // namespace tern
