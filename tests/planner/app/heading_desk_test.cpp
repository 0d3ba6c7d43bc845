#include "planner/app/heading_desk.h"

#include <gtest/gtest.h>

#include <memory>

#include "messages/codec.h"
#include "planner/heading/heading_planner.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};

/// A heading of a vehicle at rest, of which nothing around it was ever seen.
PlanHeading heading_by(UnseenMode mode, bool looks, bool has_field) {
  const TimedSpline rest = resting_at(Vec3(0, 0, 1), kStart);
  const HorizonRequest request = request_at(rest.end() + Duration{100'000}, rest);
  PlannerConfig config;
  config.unseen = mode;
  config.unseen_movers.looks = looks;
  PlanningWorld world = world_of({}, Goal{}, request);
  if (has_field) {
    auto known = std::make_shared<UnseenKnowledge>();
    known->field.emplace(UnseenGrid{Eigen::Vector2d(-8, -8), kUnseenCell, 128, 128}, 2.0, 0.4);
    known->at = request.t_s;
    world.unseen = std::move(known);
  }
  Plan plan;
  plan.outcome = PlanOutcome::KeepCommitted;
  plan.trajectory = rest;
  plan.local_goal = Vec3(4, 0, 1);
  return plan_heading_in(world, request, plan, config, {}, heading_start({0.3, 0.0}, rest.interval)).value();
}

TEST(PlanHeadingIn, CountsUnseenSpaceOnlyIfAskedTo) {
  const auto without = encode(heading_by(UnseenMode::Ignore, false, false));
  EXPECT_EQ(encode(heading_by(UnseenMode::Ignore, true, true)), without);
  EXPECT_EQ(encode(heading_by(UnseenMode::Passive, false, true)), without);
  EXPECT_EQ(encode(heading_by(UnseenMode::Passive, true, false)), without) << "before the first picture";
  EXPECT_GT(heading_by(UnseenMode::Passive, true, true).unseen_term, 0.0);
}

}  // namespace
}  // namespace tern
