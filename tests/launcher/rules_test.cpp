#include "launcher/rules.h"

#include <gtest/gtest.h>

#include <csignal>
#include <vector>

namespace tern {
namespace {

constexpr Duration kShortRun{4'999'999}, kLongRun{5'000'000};

TEST(Backoff, DoublesUpToASecond) {
  Backoff backoff;
  std::vector<std::int64_t> ms;
  for (int restart = 0; restart < 9; ++restart) ms.push_back(backoff.next(kShortRun).us / 1000);
  EXPECT_EQ(ms, (std::vector<std::int64_t>{10, 20, 40, 80, 160, 320, 640, 1000, 1000}));
}

TEST(Backoff, BeginsAnewAfterALongRun) {
  Backoff backoff;
  for (int restart = 0; restart < 4; ++restart) (void)backoff.next({});
  EXPECT_EQ(backoff.next(kLongRun), Duration{10'000});
  EXPECT_EQ(backoff.next({}), Duration{20'000});
}

TEST(ProcessEnd, IsFinalWhereAnotherRunCannotMendIt) {
  for (const int code : {0, 2, 3, 126, 127}) EXPECT_TRUE(is_permanent({code, 0})) << code;
  for (const int code : {1, 4, 70, 255}) EXPECT_FALSE(is_permanent({code, 0})) << code;
  for (const int signal : {SIGKILL, SIGSEGV, SIGINT}) EXPECT_FALSE(is_permanent({0, signal})) << signal;
}

TEST(ProcessEnd, IsToldAsAShellDoes) {
  EXPECT_EQ(shell_code({70, 0}), 70);
  EXPECT_EQ(shell_code({0, SIGKILL}), 137);
  EXPECT_EQ(to_text({70, 0}), "exit code 70");
  EXPECT_EQ(to_text({0, SIGSEGV}), "signal SEGV");
  EXPECT_EQ(to_text({0, 60}), "signal 60");
}

TEST(FlightExitCode, IsTheMonitorsIfItWroteASummary) {
  for (const int code : {0, 1, 2, 3}) {
    EXPECT_EQ(code_after_flight(code, true), code);
    EXPECT_EQ(code_after_flight(code, false), kExitFailed);
  }
  for (const int code : {70, 127, 137}) EXPECT_EQ(code_after_flight(code, true), kExitFailed);
  for (const bool has_summary : {false, true}) {
    EXPECT_EQ(code_after_flight(kExitIncomplete, has_summary), kExitIncomplete) << "a full disk takes no summary";
  }
}

TEST(FlightExitCode, OfABrokenAuditGivesWayToACollision) {
  for (const int code : {0, 1, 2}) EXPECT_EQ(code_after_audit(code, 0), code);
  EXPECT_EQ(code_after_audit(0, 1), kExitBroken);
  EXPECT_EQ(code_after_audit(1, 1), 1);
  EXPECT_EQ(code_after_audit(kExitFailed, 1), kExitFailed);
  EXPECT_EQ(code_after_audit(2, 1), kExitBroken);
  for (const int no_audit : {2, 70, 139}) {
    EXPECT_EQ(code_after_audit(0, no_audit), kExitFailed);
    EXPECT_EQ(code_after_audit(kExitIncomplete, no_audit), kExitIncomplete);
  }
}

TEST(FlightExitCode, OfAFlightThatTheAuditCouldNotJudgeAsAWholeIsNeverZero) {
  for (const int part : {3, 4}) {
    EXPECT_EQ(code_after_audit(0, part), kExitIncomplete);
    for (const int code : {1, 2, kExitFailed, kExitIncomplete, 130}) EXPECT_EQ(code_after_audit(code, part), code);
  }
}

}  // namespace
}  // namespace tern
