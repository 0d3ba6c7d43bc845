// tern-planner's own process with a plan() that breaks (broken_plan.cpp). Runs inside tests/support/hermetic.sh.
#include <gtest/gtest.h>

#include <csignal>

#include "messages/codec.h"
#include "runtime/process.h"
#include "tests/support/network_end.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

constexpr std::int64_t kNeverAnswered = 1, kThrows = 2;

class BrokenPlanner : public testing::Test, protected NetworkEnd {
 protected:
  /// Leaves time for the request to arrive on a busy machine: a late request is not planned.
  void ask(std::int64_t id) {
    const UTime now = clock.now();
    HorizonRequest request = support::request_at(now + Duration{3'000'000}, support::resting_at(Vec3(0, 0, 1), now));
    request.id = id;
    bus->publish(channels::kHorizonRequest, request);
  }
  static void expect_said(const Child& child, const std::string& text) {
    EXPECT_NE(child.output.find(text), std::string::npos) << child.output;
  }
};

TEST_F(BrokenPlanner, AStuckWorkerEndsTheProcessWith70) {
  Child planner({TERN_BROKEN_PLANNER});
  ASSERT_TRUE(wait_until_ready());
  ask(kNeverAnswered);
  EXPECT_EQ(planner.wait(), kExitStuck);
  expect_said(planner, "the worker has missed two deadlines");
}

TEST_F(BrokenPlanner, AnErrorInTheWorkerIsSaidAndEndsTheProcessWith70) {
  Child planner({TERN_BROKEN_PLANNER});
  ASSERT_TRUE(wait_until_ready());
  ask(kThrows);
  EXPECT_EQ(planner.wait(), kExitStuck);
  expect_said(planner, "a list of 99 pieces, at most 48");
}

TEST_F(BrokenPlanner, IsStartedAgainHoweverItBroke) {
  Child keeper({TERN_LAUNCH, "keep", "--", TERN_BROKEN_PLANNER});
  for (const std::int64_t id : {kNeverAnswered, kThrows}) {
    ASSERT_TRUE(wait_until_ready());
    ask(id);
  }
  ASSERT_TRUE(wait_until_ready());
  keeper.signal(SIGTERM);
  EXPECT_EQ(keeper.wait(), 0);
  expect_said(keeper, "ended with exit code 70; restart 1 in");
  expect_said(keeper, "ended with exit code 70; restart 2 in");
}

}  // namespace
}  // namespace tern
