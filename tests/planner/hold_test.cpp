#include "planner/hold.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "planner/duration.h"
#include "planner/problem/tuning.h"
#include "planner/safety/thrust_set.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

Limits limits_of(double v, double a, double j) { return {Vec3::Constant(v), Vec3::Constant(a), Vec3::Constant(j)}; }

double drawn(int low, int high) { return *rc::gen::inRange(low, high) * 0.01; }

TEST(SideStepTime, IsTheQuickestAxisThatAMoverAlongTheQuickestOneLeaves) {
  Limits limits = limits_of(1.0, 1.0, std::numeric_limits<double>::infinity());
  limits.v_max = Vec3(1.0, 2.0, 4.0);
  const Vec3 half = Vec3::Constant(5.0);
  const double by_y = kStopScale * min_duration(MotionSample{}, Vec3(0, 10, 0), limits);
  EXPECT_DOUBLE_EQ(side_step_time(limits, half, half), by_y);
}

RC_GTEST_PROP(SideStepTime, GrowsWithTheMoverAndIsNeverLessThanWithoutAJerkLimit, ()) {
  const double v = drawn(5, 600);
  const double a = drawn(10, 2000);
  const double j = drawn(100, 20'000);
  const Vec3 body = Vec3::Constant(drawn(0, 50));
  const Vec3 mover(drawn(1, 200), drawn(1, 200), drawn(1, 200));
  const double time = side_step_time(limits_of(v, a, j), body, mover);
  RC_ASSERT(time >= side_step_time(limits_of(v, a, std::numeric_limits<double>::infinity()), body, mover));
  RC_ASSERT(side_step_time(limits_of(v, a, j), body, 2.0 * mover) >= time - 1e-12);
}

RC_GTEST_PROP(HoldDemand, AsksForWhatTheVehicleNeedsAsFarAsPredictionsReach, ()) {
  HoldDemand hold;
  hold.side_step_s = drawn(0, 800);
  hold.predicted_s = drawn(0, 500);
  const double end_s = drawn(0, 600);
  const double required = hold.required(end_s);
  RC_ASSERT(required >= hold.required_s);
  if (required > hold.required_s) RC_ASSERT(end_s + required <= hold.predicted_s + 1e-12);
  RC_ASSERT(end_s + required >= std::min(hold.side_step_s, hold.predicted_s) - 1e-12);
  RC_ASSERT(hold.cap(end_s) >= required);
  RC_ASSERT(hold.cap_of_stop(end_s) >= hold.cap(end_s));
}

TEST(HoldDemand, TakesHalfTheHorizonAtMost) {
  PlannerConfig config;
  EXPECT_EQ(hold_demand(HorizonRequest{}, config, {}, 3.0).cap_s, config.hold_cap_s);
  config.hold_required_s = config.hold_cap_s = 10.0;
  const HoldDemand shorter = hold_demand(HorizonRequest{}, config, {}, 4.3);
  EXPECT_EQ(shorter.cap_s, 2.15);
  EXPECT_EQ(shorter.required_s, 2.15);
  EXPECT_EQ(hold_demand(HorizonRequest{}, config, {}, 1e9).cap_s, 10.0);
}

// The demand is that of the worst single mover, not of a box as wide as the widest and as high as the highest.
TEST(HoldDemand, GivesTheTimeToLeaveTheWayOfEachMover) {
  Rng rng(1);
  for (int k = 0; k < 100; ++k) {
    std::vector<Track> tracks;
    for (int id = 0; id < 20; ++id) {
      tracks.push_back(straight_mover(id, Vec3::Zero(), Vec3::UnitX(), 0.3, UTime{}, 3.0));
      tracks.back().half_extents = Vec3(rng.uniform(0.1, 2.0), rng.uniform(0.1, 2.0), rng.uniform(0.1, 2.0));
    }
    const HorizonRequest request = request_at(UTime{1'000'000}, resting_at(Vec3::Zero(), UTime{}));
    double longest_s = 0.0;
    for (const Track& track : tracks) {
      const Vec3 body = request.body.half_extents();
      longest_s = std::max(longest_s, side_step_time(per_axis_limits(request.limits), body, track.half_extents));
    }
    EXPECT_EQ(hold_demand(request, PlannerConfig{}, obstacles_of(tracks), 4.5).side_step_s, longest_s);
  }
}

RC_GTEST_PROP(HoldDemand, AsksForNothingAfterItsEnd, ()) {
  HoldDemand hold;
  hold.until_s = drawn(0, 300);
  hold.side_step_s = drawn(0, 800);
  hold.predicted_s = 4.5;
  const double end_s = drawn(0, 600);
  RC_ASSERT(hold.required(end_s) <= std::max(0.0, hold.until_s - end_s) + 1e-12);
}

}  // namespace
}  // namespace tern
