#include "mavlink/clock_fit.h"

#include <gtest/gtest.h>

namespace tern::mavlink {
namespace {

/// Ten requests a second to a clock that advances `rate` seconds per second of ours.
void exchange(ClockFit& fit, UTime& now, double seconds, double rate, Duration round_trip = Duration{2'000}) {
  for (const UTime end = now + Duration::from_seconds(seconds); now < end; now = now + Duration{100'000}) {
    const UTime middle{now.us + round_trip.us / 2};
    fit.add(now, static_cast<std::int64_t>(rate * static_cast<double>(middle.us)), now + round_trip);
  }
}

TEST(ClockFit, TellsOffsetAndRate) {
  ClockFit fit;
  UTime now{5'000'000};
  exchange(fit, now, 3.0, 0.99);
  EXPECT_NEAR(fit.rate(), 0.99, 1e-6);
  const auto ours = fit.ours(static_cast<std::int64_t>(0.99 * 8e6));
  ASSERT_TRUE(ours);
  EXPECT_NEAR(static_cast<double>(ours->us), 8e6, 10.0);
}

TEST(ClockFit, AnExchangeThatWaitedDoesNotEndIt) {
  ClockFit fit;
  UTime now{5'000'000};
  exchange(fit, now, 3.0, 1.0);
  // The request waited 400 ms in the autopilot's buffer and was then answered at once.
  fit.add(now, now.us + 400'000, now + Duration{401'000});
  EXPECT_TRUE(fit.ready());
  const auto ours = fit.ours(now.us);
  ASSERT_TRUE(ours);
  EXPECT_NEAR(static_cast<double>(ours->us), static_cast<double>(now.us), 1'000.0) << "nor does it count";
}

TEST(ClockFit, FollowsAClockWhoseRateChanges) {
  ClockFit fit;
  UTime now{0};
  std::int64_t theirs_us = 0;
  double worst = 0.0;
  for (int k = 0; k < 200; ++k, now = now + Duration{100'000}) {
    const double rate = k < 100 ? 1.0 : 0.6;
    theirs_us += static_cast<std::int64_t>(rate * 1e5);
    fit.add(now, theirs_us, now + Duration{2'000});
    if (k < 10) continue;
    const auto ours = fit.ours(theirs_us);
    ASSERT_TRUE(ours) << k;
    worst = std::max(worst, std::abs(static_cast<double>(ours->us - now.us - 1'000)));
  }
  EXPECT_LT(worst, 200'000.0);
  EXPECT_NEAR(fit.rate(), 0.6, 1e-3);
}

TEST(ClockFit, BeginsAnewWithAnAutopilotThatHasRestarted) {
  ClockFit fit;
  UTime now{5'000'000};
  exchange(fit, now, 3.0, 1.0);
  fit.add(now, 0, now + Duration{2'000});
  EXPECT_FALSE(fit.ready());
}

}  // namespace
}  // namespace tern::mavlink
