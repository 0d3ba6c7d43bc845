#include "planner/incumbent.h"

#include <gtest/gtest.h>

#include "planner/plan_workspace.h"
#include "tests/support/plan_judge.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};

TEST(Incumbent, EvaluatesTheWholeCostAgainForANewCourse) {
  const TimedSpline rest = resting_at(Vec3(0, 0, 1), kStart);
  const HorizonRequest request = request_at(rest.end() + Duration{500'000}, rest);
  const PlanningWorld world = world_of({}, go_to(Vec3(10, 0, 1)), request);
  const PlannerConfig config;
  PlanWorkspace workspace;
  const Surroundings near = surroundings(request, world, config, workspace);
  PlanLog log(nullptr);
  Budget budget = Budget::unlimited();
  PlanTools tools{budget, workspace, log};
  Incumbent incumbent(near, Plan{}, std::nullopt, tools);
  Candidate candidate;
  candidate.outcome = PlanOutcome::Optimized;
  candidate.trajectory = resting_at(Vec3(1, 0, 1), request.t_s);
  candidate.cost.jerk = 3.0;
  candidate.cost.distance_to_goal = 3.0;
  incumbent.offer(candidate);
  Course course = course_in_place(near);
  course.local.goal = Vec3(3, 0, 1);
  incumbent.set_course(course);
  const PlanCost cost = incumbent.answer(PlanReason::None).cost;
  EXPECT_NEAR(cost.distance_to_goal, 2.0, 1e-12);
  EXPECT_NEAR(cost.total, config.optimization.weight_jerk * 3.0 + config.optimization.weight_goal * 4.0, 1e-12);
}

}  // namespace
}  // namespace tern
