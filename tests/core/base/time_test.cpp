#include "core/base/time.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tern {
namespace {

RC_GTEST_PROP(Duration, SurvivesTheWayThroughSeconds, (std::int32_t us, std::int32_t scale)) {
  const Duration d{static_cast<std::int64_t>(us) * (1 + scale % 1000)};
  RC_ASSERT(Duration::from_seconds(d.seconds()) == d);
}

TEST(Duration, RoundsSecondsToTheNearestMicrosecondOnBothSidesOfZero) {
  EXPECT_EQ(Duration::from_seconds(0.1).us, 100'000);
  EXPECT_EQ(Duration::from_seconds(1.4e-6).us, 1);
  EXPECT_EQ(Duration::from_seconds(1.6e-6).us, 2);
  EXPECT_EQ(Duration::from_seconds(-1.4e-6).us, -1);
  EXPECT_EQ(Duration::from_seconds(-1.6e-6).us, -2);
}

TEST(UTime, KeepsEveryMicrosecondAtTodaysEpoch) {
  const UTime now{1'790'000'000'123'457};
  EXPECT_EQ((now + Duration{1}) - now, Duration{1});
  EXPECT_EQ((now - Duration{1}) - now, Duration{-1});
  EXPECT_LT(now, now + Duration{1});
}

RC_GTEST_PROP(UTime, DifferencesUndoSums, (std::int32_t epoch, std::int32_t span, std::int16_t factor)) {
  const UTime t{epoch};
  const Duration d = Duration{span} * factor;
  RC_ASSERT((t + d) - t == d);
  RC_ASSERT((t + d) - d == t);
  RC_ASSERT((t < t + d) == (d > Duration{}));
}

}  // namespace
}  // namespace tern
