#include "monitor/live_line.h"

#include <gtest/gtest.h>

#include <limits>

namespace tern {
namespace {

TEST(LiveLine, ShowsWhatAPersonWantsToKnow) {
  LiveView view;
  view.flying = true;
  view.elapsed_s = 6.43;
  view.progress = 0.478;
  view.speed_mps = 5.934;
  view.nearest_m = 0.717;
  view.replan_p50_ms = 4.12;
  view.replan_p99_ms = 12.34;
  view.requests = 128;
  view.answered_in_time = 127;
  EXPECT_EQ(live_line(view),
            "   6.4 s   48 %   5.93 m/s  nearest 0.72 m  replan 4.1/12.3 ms (p50/p99)  in time 127/128");
}

TEST(LiveLine, OfASlowedFlightSaysItsPaceBesideTheTimesOfTheSystemsClock) {
  LiveView view;
  view.flying = true;
  view.replan_p50_ms = 8.2;
  view.replan_p99_ms = 24.6;
  view.pace = 0.5;
  EXPECT_NE(live_line(view).find("replan 8.2/24.6 ms at pace 0.5 (p50/p99)"), std::string::npos) << live_line(view);
}

TEST(LiveLine, ShowsTheNearestWallWhereAMapHasOne) {
  LiveView view;
  view.flying = true;
  view.nearest_m = 0.717;
  EXPECT_EQ(live_line(view).find("wall"), std::string::npos);
  view.nearest_wall_m = 0.032;
  EXPECT_NE(live_line(view).find("nearest 0.72 m, wall 0.03 m"), std::string::npos) << live_line(view);
}

TEST(LiveLine, ShowsADashForWhatIsNotKnown) {
  LiveView view;
  view.flying = true;
  view.nearest_m = view.replan_p50_ms = view.replan_p99_ms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(live_line(view).find("nearest - m  replan -/- ms"), std::string::npos);
}

TEST(LiveLine, SaysWhatTheNewestPlanExcusesItselfWith) {
  LiveView view;
  view.flying = true;
  view.reason = PlanReason::StaleWorld;
  EXPECT_TRUE(live_line(view).ends_with("(stale world)")) << live_line(view);
}

TEST(LiveLine, KeepsWhatIsWrongWhereATerminalIsNarrow) {
  LiveView view;
  view.flying = true;
  view.elapsed_s = 106.4;
  view.replan_p50_ms = 14.1;
  view.replan_p99_ms = 112.3;
  view.requests = view.answered_in_time = 12800;
  view.reason = PlanReason::StartInCollision;
  const std::string whole = live_line(view);
  EXPECT_GT(whole.size(), 100U);
  for (std::size_t columns = 70; columns < whole.size(); ++columns) {
    const std::string line = live_line(view, columns);
    EXPECT_LE(line.size(), columns);
    EXPECT_TRUE(line.ends_with("(start in collision)")) << line;
  }
  EXPECT_EQ(live_line(view, whole.size()), whole);
}

TEST(LiveLine, SaysThatTheNewestPlanDoesNotKnowAllTracks) {
  LiveView view;
  view.flying = true;
  EXPECT_EQ(live_line(view).find("left out"), std::string::npos);
  view.left_out = 12;
  EXPECT_TRUE(live_line(view).ends_with("  12 tracks left out")) << live_line(view);
}

TEST(LiveLine, SaysWhoIsWaitedFor) {
  LiveView view;
  EXPECT_EQ(live_line(view), "waiting for the simulator");
  view.waiting = "tern-planner: a map";
  EXPECT_EQ(live_line(view), "waiting for tern-planner: a map");
}

TEST(LiveLine, FitsATerminalWithoutCuttingACharacter) {
  EXPECT_EQ(fit("abcdef", 4), "abcd");
  EXPECT_EQ(fit("abc", 4), "abc");
  EXPECT_EQ(fit("äöüß", 2), "äö");
  EXPECT_EQ(fit("", 0), "");
}

}  // namespace
}  // namespace tern
