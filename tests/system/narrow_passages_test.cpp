// Narrow static passages and traps: as exact boxes, and as a map with voxels of 0.25 m shows them.
#include <gtest/gtest.h>

#include "core/geometry/box.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class NarrowPassage : public ::testing::TestWithParam<const char*> {};

TEST_P(NarrowPassage, IsFlownThrough) { fly_and_expect_all_well(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Scenario, NarrowPassage, ::testing::Values("window", "u_trap", "slalom"),
                         [](const auto& flight) { return std::string(flight.param); });

/// Checks, plan by plan, that the map's walls are not crossed; the referee knows only obstacles.
void expect_clear_of(const std::vector<Box>& walls, const Exchange& exchange, double radius) {
  for (const Plan& plan : exchange.plans) {
    if (plan.outcome == PlanOutcome::NoPlan) continue;
    const ClampedSpline spline = plan.trajectory.spline();
    for (double t = 0.0; t < spline.duration_s(); t += 0.005) {
      const Vec3 p = spline.sample(t).p;
      for (const Box& wall : walls) ASSERT_GT(wall.exteriorDistance(p), radius) << "request " << plan.request_id;
    }
  }
}

void fly_and_expect_clear(const std::string& scenario, const std::vector<Box>& walls) {
  Exchange exchange;
  const VirtualFlight flight = fly_virtually(scenario_file(scenario), {}, &exchange);
  expect_reached(flight.result);
  expect_answered_once_and_in_time(flight.executor, exchange);
  expect_clear_of(walls, exchange, 0.1);
}

TEST(NarrowPassageOfAMap, TheWindowIsFlownThrough) {
  fly_and_expect_clear("window_map",
                       {Box(Vec3(5.85, 0.7, 0), Vec3(6.15, 5, 3)), Box(Vec3(5.85, -5, 0), Vec3(6.15, 0.1, 3)),
                        Box(Vec3(5.85, 0.1, 0), Vec3(6.15, 0.7, 1.6)), Box(Vec3(5.85, 0.1, 2.2), Vec3(6.15, 0.7, 3))});
}

TEST(NarrowPassageOfAMap, TheTrapIsFlownAround) {
  fly_and_expect_clear("u_trap_map", {Box(Vec3(13.8, -4, 0), Vec3(14.2, 4, 3)), Box(Vec3(6, 3.6, 0), Vec3(14, 4, 3)),
                                      Box(Vec3(6, -4, 0), Vec3(14, -3.6, 3))});
}

}  // namespace
}  // namespace tern::testing
