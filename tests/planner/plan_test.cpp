#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "messages/codec.h"
#include "planner/planner.h"
#include "planner/problem/tuning.h"
#include "tests/support/effort.h"
#include "tests/support/flat_outputs.h"
#include "tests/support/plan_judge.h"
#include "tests/support/random_shares.h"
#include "tests/support/random_splines.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};

PlannerConfig quick() {
  PlannerConfig config;
  config.search.max_expansions = 120;
  return config;
}

Plan answer(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config = quick()) {
  Budget budget = Budget::unlimited();
  return plan(request, world, config, budget).plan;
}

/// A vehicle somewhere on a random committed trajectory, or at rest at its end, among up to 60 movers, standing boxes
/// and voxels.
struct Draw {
  HorizonRequest request;
  PlanningWorld world;
  PlannerConfig config = quick();
};

VoxelMap random_map(Rng& rng, const Vec3& around) {
  VoxelMap map = support::free_map({32, 32, 16}, 0.25, Vec3(around - Vec3(4, 4, 2)));
  if (rng.uniform() < 0.5) support::sprinkle(map, rng, 0.002, VoxelLabel::Occupied);
  if (rng.uniform() < 0.3) support::paint(map, {4, 4, 4}, {12, 12, 12}, VoxelLabel::Attractive);
  if (rng.uniform() < 0.3) support::paint(map, {18, 18, 4}, {26, 26, 12}, VoxelLabel::Repulsive);
  map.version = map.compute_version();
  return map;
}

/// An estimated track with an α of one metre.
void make_estimated(Rng& rng, Track& track) {
  track.kind = TrackKind::Estimated;
  for (Vec3& alpha : track.alpha) {
    alpha = Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    track.shares.push_back(random_shares(rng));
  }
}

Draw random_draw(std::uint64_t seed) {
  Rng rng(seed);
  Draw d;
  d.config.intervals = random_integer(rng, 4, 8);
  d.config.sphere_radius_m = rng.uniform() < 0.5 ? 4.0 : rng.uniform(1.0, 4.0);
  d.config.semantic_cost = rng.uniform() < 0.5 ? SemanticCost::Exposure : SemanticCost::MeanDistance;
  if (rng.uniform() < 0.2) d.config.optimization.method = OptimizationMethod::SearchOnly;
  Limits limits;
  if (rng.uniform() < 0.3) limits.j_max = Vec3::Constant(rng.uniform(60.0, 150.0));
  const Vec3 home(0, 0, 1);
  const TimedSpline committed = random_trajectory(rng, home, kStart, limits, random_integer(rng, 4, 10));
  const double share = rng.uniform() < 0.2 ? 1.2 : rng.uniform();
  const UTime t_s =
      kStart + Duration{static_cast<std::int64_t>(share * static_cast<double>((committed.end() - kStart).us))};
  d.request = request_at(t_s, committed);
  d.request.limits = limits;
  d.request.body = body_of(kBodyKinds[random_integer(rng, 0, 2)]);
  if (rng.uniform() < 0.4) d.request.flight_box = box_around(home, Vec3(12, 12, 6));
  std::vector<Track> tracks;
  const Box where = box_around(d.request.start.p, Vec3(5, 5, 3));
  const int movers = rng.uniform() < 0.2 ? 60 : random_integer(rng, 0, 25);
  for (int id = 1; id <= movers; ++id)
    tracks.push_back(random_mover(rng, id, where, t_s - Duration{250'000}, rng.uniform(2.0, 5.0)));
  if (rng.uniform() < 0.5) {
    for (Track& track : tracks) make_estimated(rng, track);
  }
  for (int id = 101; id <= 100 + random_integer(rng, 0, 4); ++id) {
    tracks.push_back(
        standing_box(id, box_around(Vec3(d.request.start.p + random_vector(rng, 4.0)), Vec3(0.2, 0.2, 2.0)), t_s));
  }
  Goal goal = go_to(d.request.start.p + random_vector(rng, 8.0));
  if (rng.uniform() < 0.1) goal.mode = GoalMode::Hold;
  d.world = world_of(std::move(tracks), goal, d.request, d.config, random_map(rng, d.request.start.p));
  return d;
}

TEST(Planner, NeverReturnsAPlanTheCheckerRejects) {
  int by_outcome[kPlanOutcomes] = {};
  const auto draws = static_cast<std::uint64_t>(support::at_effort(1000));
  for (std::uint64_t seed = 1; seed <= draws; ++seed) {
    const Draw d = random_draw(seed);
    const Plan got = answer(d.request, d.world, d.config);
    ++by_outcome[static_cast<int>(got.outcome)];
    EXPECT_EQ(fault_of(got, d.request, d.world, d.config), "")
        << "seed " << seed << ", outcome " << static_cast<int>(got.outcome);
    ASSERT_NO_THROW((void)encode(got)) << "seed " << seed;
  }
  for (const PlanOutcome outcome : {PlanOutcome::Optimized, PlanOutcome::KeepCommitted, PlanOutcome::NoPlan}) {
    EXPECT_GT(by_outcome[static_cast<int>(outcome)], 5) << "outcome " << static_cast<int>(outcome);
  }
}

TEST(Planner, LeavesTheGroundItStandsOnAndComesNoNearer) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Rng rng(seed);
    const Vec3 home(0, 0, 1);
    HorizonRequest request = request_at(kStart, resting_at(home, kStart - Duration{1'000'000}));
    request.body = body_of(kBodyKinds[seed % 2]);
    const double top = home.z() - request.body.half_extents().z();
    std::vector<Track> tracks{standing_box(1, Box(Vec3(-9, -9, top - 1.0), Vec3(9, 9, top)), kStart)};
    const Vec3 goal(rng.uniform(-6.0, 6.0), rng.uniform(-6.0, 6.0), rng.uniform(1.1, 4.0));
    const PlanningWorld world = world_of(std::move(tracks), go_to(goal), request, quick());
    const Plan got = answer(request, world);
    ASSERT_NE(got.outcome, PlanOutcome::NoPlan) << "seed " << seed << " " << static_cast<int>(got.reason);
    const ClampedSpline spline = got.trajectory.spline();
    ASSERT_GT((spline.sample(spline.duration_s()).p - home).norm(), 0.3) << "seed " << seed;
    for (double t = 0.0; t < spline.duration_s(); t += 0.002) {
      ASSERT_GE(spline.sample(t).p.z(), home.z() - kBoxTolerance) << "seed " << seed;
    }
  }
}

TEST(Planner, EveryAnswerOnTheWayIsCertifiedTooAndTheFirstIsTheFallback) {
  const auto draws = static_cast<std::uint64_t>(support::at_effort(300));
  for (std::uint64_t seed = 5001; seed <= 5000 + draws; ++seed) {
    const Draw d = random_draw(seed);
    RecordingObserver observer;
    Budget budget = Budget::unlimited();
    const Plan last = plan(d.request, d.world, d.config, budget, &observer).plan;
    ASSERT_FALSE(observer.answers.empty());
    const PlanOutcome first = observer.answers.front().outcome;
    EXPECT_TRUE(first == PlanOutcome::KeepCommitted || first == PlanOutcome::NoPlan);
    for (const Plan& standing : observer.answers) {
      EXPECT_EQ(fault_of(standing, d.request, d.world, d.config), "") << "seed " << seed;
      ASSERT_NO_THROW((void)encode(standing));
    }
    // If planning ends here, the watchdog would send what plan() returns; only the reason may differ.
    const Plan& standing = observer.answers.back();
    EXPECT_EQ(standing.outcome, last.outcome) << "seed " << seed;
    EXPECT_EQ(standing.trajectory.control_points, last.trajectory.control_points) << "seed " << seed;
    EXPECT_EQ(standing.cost.total, last.cost.total) << "seed " << seed;
    EXPECT_EQ(standing.confidence, last.confidence) << "seed " << seed;
  }
}

TEST(Planner, TheSameRequestInTheSameWorldGivesTheSameBytes) {
  const auto draws = static_cast<std::uint64_t>(support::at_effort(150));
  for (std::uint64_t seed = 6001; seed <= 6000 + draws; ++seed) {
    const Draw first = random_draw(seed);
    const Draw second = random_draw(seed);
    ASSERT_EQ(encode(answer(first.request, first.world, first.config)),
              encode(answer(second.request, second.world, second.config)))
        << "seed " << seed;
  }
}

TEST(Planner, WhatABudgetCutReplaysToTheSameBytes) {
  int cut = 0;
  for (std::uint64_t seed = 701; seed <= 740; ++seed) {
    const Draw d = random_draw(seed);
    const auto s = static_cast<std::int64_t>(seed);
    Budget live([s](const BudgetCut& here) {
      const int attempt = static_cast<int>(here.phase) * kMaxAttempts + here.attempt;
      if (here.stage == Stage::LocalGoal) return attempt >= 1 + s % 4;
      if (here.stage == Stage::Search) return here.count >= 5 + (s * 7 + attempt * 13) % 60;
      return here.count >= (s + attempt) % 30;
    });
    const Plan first = plan(d.request, d.world, d.config, live).plan;
    EXPECT_EQ(fault_of(first, d.request, d.world, d.config), "") << "seed " << seed;
    if (!first.cuts.empty()) ++cut;
    Budget replay = Budget::replay(first.cuts);
    ASSERT_EQ(encode(first), encode(plan(d.request, d.world, d.config, replay).plan)) << "seed " << seed;
  }
  EXPECT_GT(cut, 20);
}

/// A vehicle at rest at home, with a goal to the east and no obstacles.
class PlannerAlone : public ::testing::Test {
 protected:
  HorizonRequest request_ = request_at(kStart + Duration{1'000'000}, resting_at(Vec3(0, 0, 1), kStart));
  Goal goal_ = go_to(Vec3(10, 0, 1));
};

TEST_F(PlannerAlone, HeadsForTheGoal) {
  const PlanningWorld world = world_of({}, goal_, request_);
  const Plan got = answer(request_, world);
  EXPECT_EQ(got.outcome, PlanOutcome::Optimized);
  EXPECT_EQ(got.reason, PlanReason::None);
  EXPECT_GT(got.trajectory.control_points.rightCols<1>().x(), 3.0);
  EXPECT_EQ(got.inputs.request, request_.header.name);
  EXPECT_EQ(got.inputs.goal, goal_.header.name);
  EXPECT_EQ(got.inputs.predictions, world.predictions->set.header.name);
  EXPECT_EQ(got.inputs.map_version, world.map->version);
  EXPECT_FALSE(got.relaxed);
  EXPECT_GE(got.hold.seconds(), 1.5 - 1e-6);
}

TEST_F(PlannerAlone, SaysSearchOnlyWithoutTheOptimizer) {
  PlannerConfig config = quick();
  config.optimization.method = OptimizationMethod::SearchOnly;
  EXPECT_EQ(answer(request_, world_of({}, goal_, request_), config).outcome, PlanOutcome::SearchOnly);
}

TEST_F(PlannerAlone, AStaleOrMissingWorldIsSaidAndNotFlownIn) {
  const PlanningWorld whole = world_of({}, goal_, request_);
  const auto expect_stale = [&](const PlanningWorld& world) {
    const Plan got = answer(request_, world);
    EXPECT_EQ(got.outcome, PlanOutcome::NoPlan);
    EXPECT_EQ(got.reason, PlanReason::StaleWorld);
    ASSERT_NO_THROW((void)encode(got));
  };
  PlanningWorld world = whole;
  world.predictions = nullptr;
  expect_stale(world);
  world = whole;
  world.map = nullptr;
  expect_stale(world);
  world = whole;
  world.goal = nullptr;
  expect_stale(world);
  expect_stale(PlanningWorld{});
  TrackSet old;
  old.made_at = request_.header.utime - Duration{300'001};
  world = whole;
  world.predictions = std::make_shared<const PredictionProducts>(old);
  expect_stale(world);
  old.made_at = request_.header.utime - Duration{300'000};
  world.predictions = std::make_shared<const PredictionProducts>(old);
  EXPECT_NE(answer(request_, world).reason, PlanReason::StaleWorld);
}

std::vector<Track> cage(const Vec3& around, double half) {
  std::vector<Track> tracks;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-half, half}) {
      Vec3 size = Vec3::Constant(half + 0.1);
      size[axis] = 0.1;
      tracks.push_back(standing_box(static_cast<std::int64_t>(tracks.size()) + 1,
                                    box_around(around + Vec3::Unit(axis) * side, size), kStart));
    }
  }
  return tracks;
}

TEST_F(PlannerAlone, AGoalBehindWallsIsSaidToBeBlocked) {
  const Plan got = answer(request_, world_of(cage(goal_.position, 1.0), goal_, request_));
  EXPECT_EQ(got.outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(got.reason, PlanReason::GoalBlocked);
}

TEST_F(PlannerAlone, AGoalBesideAWallIsNotBlocked) {
  const Vec3 half = request_.body.half_extents();
  const auto wall_at = [&](double gap) {
    return standing_box(1, box_around(goal_.position + Vec3(half.x() + 0.5 + gap, 0, 0), Vec3(0.5, 5, 5)), kStart);
  };
  EXPECT_NE(answer(request_, world_of({wall_at(0.005)}, goal_, request_)).reason, PlanReason::GoalBlocked);
  EXPECT_EQ(answer(request_, world_of({wall_at(-0.005)}, goal_, request_)).reason, PlanReason::GoalBlocked);
}

/// A body with a load that hangs 0.6 m below it. Only below the goal is there room.
TEST_F(PlannerAlone, WhatHangsBelowTheVehicleNeedsNoRoomAboveIt) {
  request_.body.vertices.resize(3, 2);
  request_.body.vertices << 0, 0, 0, 0, 0, -0.6;
  const auto slab_at = [&](double z) {
    return standing_box(1, box_around(goal_.position + Vec3(0, 0, z), Vec3(1, 1, 0.1)), kStart);
  };
  EXPECT_NE(answer(request_, world_of({slab_at(0.4)}, goal_, request_)).reason, PlanReason::GoalBlocked);
  EXPECT_EQ(answer(request_, world_of({slab_at(-0.4)}, goal_, request_)).reason, PlanReason::GoalBlocked);
}

TEST_F(PlannerAlone, AVehicleBehindWallsSaysSoToo) {
  const Plan got = answer(request_, world_of(cage(request_.start.p, 1.0), goal_, request_));
  EXPECT_EQ(got.outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(got.reason, PlanReason::GoalBlocked);
}

TEST_F(PlannerAlone, KeepsWhatIsCommittedWhenNothingBetterIsFound) {
  // Fly the first plan, and ask again with a search that cannot reach as far.
  const PlanningWorld world = world_of({}, goal_, request_);
  const Plan first = answer(request_, world);
  HorizonRequest next = request_at(request_.t_s + Duration{100'000}, first.trajectory);
  PlannerConfig crippled = quick();
  crippled.sphere_radius_m = 1.5;
  const Plan second = answer(next, world_of({}, goal_, next), crippled);
  EXPECT_EQ(second.outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(second.trajectory.control_points, first.trajectory.control_points);
  EXPECT_TRUE(second.reason == PlanReason::WorsePlan || second.reason == PlanReason::Infeasible);
}

TEST_F(PlannerAlone, KeepsWhatIsCommittedWhenTimeIsUpAndSaysWhy) {
  Budget none([](const BudgetCut&) { return true; });
  const Plan got = plan(request_, world_of({}, goal_, request_), quick(), none).plan;
  EXPECT_EQ(got.outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(got.reason, PlanReason::OutOfTime);
  EXPECT_FALSE(got.cuts.empty());
}

TEST_F(PlannerAlone, AtRestAtItsGoalItStaysThere) {
  goal_ = go_to(request_.start.p + Vec3(0.03, 0, 0));
  const Plan got = answer(request_, world_of({}, goal_, request_));
  EXPECT_EQ(got.outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(got.reason, PlanReason::AtGoal);
}

TEST_F(PlannerAlone, AskedToHoldItStaysWhereItIs) {
  goal_.mode = GoalMode::Hold;
  const Plan got = answer(request_, world_of({}, goal_, request_));
  EXPECT_EQ(got.outcome, PlanOutcome::KeepCommitted);
  EXPECT_EQ(got.reason, PlanReason::AtGoal);
}

TEST_F(PlannerAlone, ACommittedTrajectoryIsCheckedHoweverFarItGoes) {
  // The committed trajectory is from a planner with a larger sphere: the wall is outside this one's.
  TimedSpline far = resting_at(Vec3(0, 0, 1), kStart);
  far.interval = Duration{500'000};
  far.control_points.resize(3, 15);
  for (int l = 0; l < 15; ++l) far.control_points.col(l) = Vec3(std::clamp(l - 2, 0, 10) * 1.0, 0, 1);
  const HorizonRequest request = request_at(kStart, far);
  const Box wall(Vec3(7, -1, 0), Vec3(7.5, 1, 2));
  PlannerConfig nearsighted = quick();
  nearsighted.sphere_radius_m = 2.0;
  nearsighted.search.max_expansions = 1;  // nothing new is found
  const PlanningWorld by_track = world_of({standing_box(1, wall, kStart)}, go_to(Vec3(3, 0, 1)), request, nearsighted);
  const Plan first = answer(request, by_track, nearsighted);
  EXPECT_EQ(fault_of(first, request, by_track, nearsighted), "");
  EXPECT_NE(first.outcome, PlanOutcome::KeepCommitted);
  VoxelMap map = support::free_map({40, 8, 8}, 0.25, Vec3(0, -1, 0));
  support::paint(map, {28, 0, 0}, {29, 7, 7}, VoxelLabel::Occupied);
  const PlanningWorld by_map = world_of({}, go_to(Vec3(3, 0, 1)), request, nearsighted, map);
  const Plan second = answer(request, by_map, nearsighted);
  EXPECT_EQ(fault_of(second, request, by_map, nearsighted), "");
  EXPECT_NE(second.outcome, PlanOutcome::KeepCommitted);
}

TEST_F(PlannerAlone, LooksNoFartherThanMoversAreFollowed) {
  PlannerConfig config = quick();
  config.duration_scales = {1.1, 8.0, 20.0};
  request_.limits.v_max = Vec3::Constant(1.0);
  for (const double predicted_s : {0.2, 1.0, 2.0, 5.0, 20.0}) {
    const UTime from = request_.t_s;
    const std::vector<Track> near = {straight_mover(1, Vec3(3, 3.5, 1), Vec3(0, -0.1, 0), 0.4, from, predicted_s)};
    const UTime until = near[0].motion.end() + kTrackBoxReach;
    const PlanningWorld world = world_of(near, go_to(Vec3(20, 0, 1)), request_, config);
    const Plan plan = answer(request_, world, config);
    EXPECT_LE(plan.trajectory.end() + plan.hold, until) << predicted_s;
    EXPECT_EQ(fault_of(plan, request_, world, config), "") << predicted_s;
    EXPECT_EQ(plan.outcome, PlanOutcome::Optimized) << predicted_s;
  }
}

TEST_F(PlannerAlone, AMoverThatCannotReachItDoesNotShortenItsPlans) {
  request_.limits.v_max = Vec3::Constant(0.1);
  const Goal goal = go_to(Vec3(20, 0, 1));
  const Plan alone = answer(request_, world_of({}, goal, request_));
  const std::vector<Track> far = {straight_mover(1, Vec3(0, 700, 1), Vec3(0, 1, 0), 0.4, request_.t_s, 1.0)};
  const Plan plan = answer(request_, world_of(far, goal, request_));
  EXPECT_EQ(plan.outcome, PlanOutcome::Optimized);
  EXPECT_EQ(plan.trajectory.control_points, alone.trajectory.control_points);
  EXPECT_GT(plan.trajectory.end() - plan.trajectory.start, Duration{30'000'000});
}

TEST_F(PlannerAlone, SaysRelaxedWhenTheStartLiesInsideAnInflatedBoxAndFliesOutOfIt) {
  Track near = straight_mover(1, request_.start.p + Vec3(0, 0.7, 0), Vec3::Zero(), 0.4, kStart, 8.0);
  near.alpha[0] = Vec3::Constant(0.4);
  const PlanningWorld world = world_of({near}, goal_, request_);
  const Plan got = answer(request_, world);
  EXPECT_TRUE(got.relaxed);
  EXPECT_EQ(got.outcome, PlanOutcome::Evade);
  EXPECT_EQ(fault_of(got, request_, world, quick()), "");
  const Vec3 end = got.trajectory.control_points.rightCols<1>();
  EXPECT_GT(box_around(request_.start.p + Vec3(0, 0.7, 0), Vec3::Constant(0.8)).exteriorDistance(end), 1.0)
      << "it does not come out of the inflated box to where there is room";
}

TEST_F(PlannerAlone, SaysSoWhenItStartsInCollision) {
  const std::vector<Track> tracks{straight_mover(1, request_.start.p, Vec3::Zero(), 0.4, kStart, 8.0)};
  const Plan got = answer(request_, world_of(tracks, goal_, request_));
  EXPECT_EQ(got.outcome, PlanOutcome::NoPlan);
  EXPECT_EQ(got.reason, PlanReason::StartInCollision);
}

TEST_F(PlannerAlone, FromNearlyTheTopSpeedWithOutwardAccelerationItFindsANewPlan) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      for (const double outward : {1.0, 2.5}) {
        // A committed trajectory that obeys the limits and passes through such a state.
        MotionSample start;
        start.p = Vec3(0, 0, 50);
        start.v[axis] = sign * 0.98 * Limits{}.v_max[axis];
        start.a[axis] = sign * outward;
        TimedSpline committed = resting_at(start.p, kStart);
        committed.interval = Duration{axis == 2 ? 170'000 : 120'000};
        Rng rng(1);
        std::optional<Points> way;
        do {
          way = random_way_to_rest(rng, start, Limits{}, 8, committed.interval.seconds());
          ASSERT_TRUE(way);
          committed.control_points = *way;
        } while (motion_bounds(committed.spline()).v_max[axis] > Limits{}.v_max[axis]);
        const HorizonRequest request = request_at(kStart, committed);
        const PlanningWorld world = world_of({}, go_to(start.p + 10.0 * start.v), request);
        const Plan got = answer(request, world, PlannerConfig{});
        // A new plan was found; it may be worse than the committed trajectory.
        EXPECT_TRUE(got.outcome == PlanOutcome::Optimized || got.outcome == PlanOutcome::SearchOnly ||
                    got.reason == PlanReason::WorsePlan)
            << "axis " << axis << ", sign " << sign << ", " << outward << " m/s^2: outcome "
            << static_cast<int>(got.outcome) << ", reason " << static_cast<int>(got.reason);
        EXPECT_EQ(fault_of(got, request, world, PlannerConfig{}), "");
      }
    }
  }
}

TEST(PlannerInALoop, AStrongAttractionDoesNotParkTheVehicle) {
  VoxelMap map = support::free_map({48, 16, 8}, 0.25, Vec3(-1, -2, 0));
  support::paint(map, {4, 9, 2}, {16, 14, 6}, VoxelLabel::Attractive);
  for (const SemanticCost cost : {SemanticCost::Exposure, SemanticCost::MeanDistance}) {
    PlannerConfig config;
    config.semantic_cost = cost;
    config.lambda_attractive = 8.0;
    Loop loop{kStart, resting_at(Vec3(0, 0, 1), kStart), Limits{}, Body{}, config};
    const Vec3 goal(9, 0, 1);
    const HorizonRequest first = request_at(kStart, loop.committed);
    const PlanningWorld world = world_of({}, go_to(goal), first, config, map);
    int steps = 0;
    while (steps < 120 && !((loop.now().p - goal).norm() < 0.2 && loop.now().v.norm() < 0.1)) {
      loop.step([&](const HorizonRequest& request) {
        PlanningWorld now = world;
        TrackSet fresh;
        fresh.made_at = request.header.utime;
        now.predictions = std::make_shared<const PredictionProducts>(fresh);
        return now;
      });
      ++steps;
    }
    EXPECT_LT(steps, 120) << "cost " << static_cast<int>(cost) << ": at " << loop.now().p.transpose();
  }
}

/// Loops among movers, each with another vehicle: every flown plan keeps its thrust, tilt and body rates.
TEST(PlannerInALoop, AMultirotorFliesOnlyWhatItsPropellersCan) {
  double farthest = 0.0;
  int optimized = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng(seed);
    Limits limits;
    limits.dynamics = random_dynamics(rng);
    std::vector<Track> tracks;
    for (int id = 1; id <= 12; ++id) {
      tracks.push_back(random_mover(rng, id, Box(Vec3(1.5, -2.0, 0.0), Vec3(9.0, 2.0, 2.0)), kStart, 12.0));
    }
    PlannerConfig config;
    config.optimization.solver = seed % 4 == 0 ? ConvexSolver::Ipopt : ConvexSolver::Barrier;
    Loop loop{kStart, resting_at(Vec3(0, 0, 1), kStart), limits, Body{}, config};
    for (int step = 0; step < 40; ++step) {
      const auto world_at = [&](const HorizonRequest& request) {
        return world_of(tracks, go_to(Vec3(10, 0, 1)), request, config);
      };
      const Plan got = loop.step(world_at);
      if (got.outcome == PlanOutcome::Optimized) ++optimized;
      ASSERT_TRUE(flat_outputs(loop.committed.spline(), 50).within(*limits.dynamics, 1e-5))
          << "seed " << seed << ", step " << step;
    }
    farthest = std::max(farthest, loop.now().p.x());
  }
  EXPECT_GT(farthest, 5.0);
  EXPECT_GT(optimized, 50);
}

}  // namespace
}  // namespace tern
