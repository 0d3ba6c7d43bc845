#include "planner/passive_safety.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "messages/codec.h"
#include "planner/planner.h"
#include "tests/support/plan_judge.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;
using Vec2 = Eigen::Vector2d;

constexpr UTime kStart{50'000'000};

PlannerConfig config_of(UnseenMode mode) {
  PlannerConfig config;
  config.unseen = mode;
  config.search.max_expansions = 200;
  return config;
}

/// All within `free_m` of p is seen to be empty 0.1 s before t_s, and somebody may be anywhere beyond.
std::shared_ptr<const UnseenKnowledge> seen_around(const Vec2& p, double free_m, UTime t_s, double speed = 2.0) {
  auto known = std::make_shared<UnseenKnowledge>();
  const int cells = 128;
  const double cell = 0.125, half = 0.5 * cells * cell;
  known->field.emplace(UnseenGrid{p - Vec2::Constant(half), cell, cells, cells}, speed, 0.4);
  const SightFan fan{p, -std::numbers::pi, std::numbers::pi / 90, 0.0, 0.0, std::vector<double>(180, free_m)};
  known->field->update(0.0, {fan});
  known->at = t_s - Duration{100'000};
  known->pictures = 1;
  return known;
}

struct Asked {
  HorizonRequest request;
  PlanningWorld world;
};

/// A vehicle at rest for so long, whose goal is 10 m ahead in the open.
Asked at_rest_for(double seconds) {
  Asked asked;
  const UTime t_s = kStart + Duration::from_seconds(10.0);
  const TimedSpline rest = resting_at(Vec3(0, 0, 1), t_s - Duration::from_seconds(1.0));
  TimedSpline before = rest;
  before.start = before.start + (t_s - Duration::from_seconds(seconds) - rest.end());
  asked.request = request_at(t_s, before);
  asked.world = world_of({}, go_to(Vec3(10, 0, 1)), asked.request);
  return asked;
}

Plan answer(const Asked& asked, UnseenMode mode) {
  Budget budget = Budget::unlimited();
  return plan(asked.request, asked.world, config_of(mode), budget).plan;
}

double contact_of(const Asked& asked, const Plan& got) {
  return first_contact(*asked.world.unseen, got.trajectory, asked.request.t_s, upright_radius(asked.request.body));
}

TEST(PassiveSafety, KnowledgeChangesNoAnswerIfUnseenMoversAreIgnored) {
  Asked asked = at_rest_for(0.5);
  const Plan before = answer(asked, UnseenMode::Ignore);
  asked.world.unseen = seen_around(Vec2(0, 0), 1.0, asked.request.t_s);
  EXPECT_EQ(encode(answer(asked, UnseenMode::Ignore)), encode(before));
  EXPECT_LT(contact_of(asked, before), kNoContact) << "the plan goes where somebody may come from";
}

TEST(PassiveSafety, AVehicleThatSeesLittleFliesAShorterPlanThatIsSafe) {
  for (const double free_m : {1.2, 1.6, 2.2, 3.0}) {
    Asked asked = at_rest_for(0.5);
    asked.world.unseen = seen_around(Vec2(0, 0), free_m, asked.request.t_s);
    const Plan got = answer(asked, UnseenMode::Passive);
    EXPECT_EQ(contact_of(asked, got), kNoContact) << free_m;
    EXPECT_NE(got.outcome, PlanOutcome::KeepCommitted) << free_m;
    const double reached = got.trajectory.control_points.rightCols<1>().x();
    EXPECT_GT(reached, 0.05) << free_m;
    EXPECT_LT(reached, free_m) << free_m;
  }
}

TEST(PassiveSafety, InTheOpenThePlanIsTheOneOfIgnore) {
  Asked asked = at_rest_for(0.5);
  asked.world.unseen = seen_around(Vec2(0, 0), 20.0, asked.request.t_s, 0.5);
  EXPECT_EQ(answer(asked, UnseenMode::Passive).trajectory.control_points,
            answer(asked, UnseenMode::Ignore).trajectory.control_points);
}

TEST(PassiveSafety, AVehicleWithoutASafePlanWaitsAndThenDeparts) {
  for (const bool has_pictures : {false, true}) {
    Asked waiting = at_rest_for(0.5), waited = at_rest_for(UnseenMovers().wait_s + 0.5);
    for (Asked* asked : {&waiting, &waited}) {
      if (has_pictures) asked->world.unseen = seen_around(Vec2(0, 0), 0.4, asked->request.t_s);
    }
    EXPECT_EQ(answer(waiting, UnseenMode::Passive).outcome, PlanOutcome::KeepCommitted);
    const Plan got = answer(waited, UnseenMode::Passive);
    EXPECT_NE(got.outcome, PlanOutcome::KeepCommitted);
    EXPECT_GT(got.trajectory.control_points.rightCols<1>().x(), 0.05);
  }
}

/// Vehicles on random trajectories with random sight: whoever is safe stays safe, and no one moves to a shorter time
/// to contact while there is another plan.
TEST(PassiveSafety, AnAnswerIsNeverTouchedSoonerThanTheCommittedTrajectory) {
  int safe = 0, unsafe = 0, flown = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Rng rng(seed);
    Asked asked;
    const TimedSpline committed = random_trajectory(rng, Vec3(0, 0, 1), kStart, Limits(), 6);
    const double share = rng.uniform(0.1, 1.1);
    const auto way_us = static_cast<double>((committed.end() - kStart).us);
    asked.request = request_at(kStart + Duration{static_cast<std::int64_t>(share * way_us)}, committed);
    asked.world = world_of({}, go_to(Vec3(rng.uniform(-8, 8), rng.uniform(-8, 8), 1)), asked.request);
    const Vec2 at = asked.request.start.p.head<2>();
    asked.world.unseen = seen_around(at + Vec2(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)), rng.uniform(0.5, 5.0),
                                     asked.request.t_s);
    const double before =
        first_contact(*asked.world.unseen, committed, asked.request.t_s, upright_radius(asked.request.body));
    const Plan got = answer(asked, UnseenMode::Passive);
    if (got.outcome == PlanOutcome::NoPlan || got.outcome == PlanOutcome::Evade) continue;
    EXPECT_GE(contact_of(asked, got), before) << "seed " << seed;
    ++(before == kNoContact ? safe : unsafe);
    flown += got.outcome != PlanOutcome::KeepCommitted ? 1 : 0;
    EXPECT_EQ(fault_of(got, asked.request, asked.world, config_of(UnseenMode::Passive)), "") << "seed " << seed;
  }
  EXPECT_GT(safe, 15);
  EXPECT_GT(unsafe, 15);
  EXPECT_GT(flown, 30);
}

}  // namespace
}  // namespace tern
