#include "planner/assurance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/planner.h"
#include "tests/support/plan_judge.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};
const AlphaShares kShares = on_all_axes({0.9F, 0.5F, 0.3F, 0.1F});
constexpr double kSideStepS = 0.5;

/// An estimated post at rest, with a constant α.
Track believed_post(std::int64_t id, const Vec3& p, double alpha) {
  Track track = straight_mover(id, p, Vec3::Zero(), 0.3, kStart, 8.0);
  track.half_extents.z() = 5.0;
  track.kind = TrackKind::Estimated;
  track.alpha = {Vec3(alpha, alpha, 0.0)};
  track.shares = {kShares};
  return track;
}

/// A track that is new at p: only its position is known, and that its speed is at most 5 m/s.
Track new_thing(std::int64_t id, const Vec3& p, UTime at) {
  constexpr int kPieces = 45;
  Track track = straight_mover(id, p, Vec3::Zero(), 0.3, at, 0.1);
  track.kind = TrackKind::Estimated;
  track.motion.pieces.assign(kPieces, track.motion.pieces.front());
  track.alpha.clear();
  for (int k = 1; k <= kPieces; ++k) track.alpha.push_back(Vec3::Constant(0.1 + 0.5 * k));
  track.shares.assign(kPieces, on_all_axes({0.98F, 0.96F, 0.94F, 0.92F}));
  track.top_speed = 5.0;
  return track;
}

/// A world whose predictions have confidence 0.99.
PlanningWorld promised_world(std::vector<Track> tracks, const HorizonRequest& request) {
  PlanningWorld world = world_of(std::move(tracks), go_to(Vec3(10, 0, 1)), request);
  TrackSet set = world.predictions->set;
  set.confidence = kConfidenceLevels[0];
  world.predictions = std::make_shared<const PredictionProducts>(std::move(set));
  return world;
}

/// A vehicle at rest for 0.5 s in a corridor 3 m wide, with a post in its middle 1.5 m ahead.
class InACorridor : public ::testing::Test {
 protected:
  InACorridor() { request_.flight_box = Box(Vec3(-5, -1.5, 0), Vec3(20, 1.5, 2)); }

  Plan answer(std::vector<Track> tracks) {
    const PlanningWorld world = promised_world(std::move(tracks), request_);
    Budget budget = Budget::unlimited();
    Plan got = plan(request_, world, PlannerConfig{}, budget).plan;
    EXPECT_EQ(fault_of(got, request_, world, PlannerConfig{}), "");
    return got;
  }

  const TimedSpline rest_ = resting_at(Vec3(0, 0, 1), kStart);
  HorizonRequest request_ = request_at(rest_.end() + Duration{500'000}, rest_);
};

TEST(ApplyAssurance, LeavesWhatIsDeclaredOrStaticAsItIs) {
  std::vector<Track> tracks = {straight_mover(1, Vec3::Zero(), Vec3::Ones(), 0.3, kStart, 2.0),
                               standing_box(2, Box(Vec3::Zero(), Vec3::Ones()), kStart),
                               believed_post(3, Vec3::Zero(), 1.0)};
  for (Track& track : tracks) track.alpha[0] = Vec3::Ones();
  std::vector<PlanningObstacle> obstacles = obstacles_of(tracks);
  for (const Assurance& assurance : reduced_assurances(kSideStepS)) {
    apply_assurance(assurance, kStart, obstacles);
    EXPECT_EQ(obstacles[0].alpha.of(tracks[0], 0), Vec3::Ones());
    EXPECT_EQ(obstacles[1].alpha.of(tracks[1], 0), Vec3::Ones());
    EXPECT_LE(obstacles[2].alpha.of(tracks[2], 0).maxCoeff(), 1.0);
  }
  apply_assurance({}, kStart, obstacles);
  EXPECT_EQ(obstacles[2].alpha.of(tracks[2], 0), Vec3::Ones());
}

TEST(ReducedAssurances, CountLessAndLess) {
  const Track track = new_thing(1, Vec3::Zero(), kStart);
  std::vector<Vec3> before = track.alpha;
  for (const Assurance& assurance : reduced_assurances(kSideStepS)) {
    std::vector<PlanningObstacle> obstacles = obstacles_of({track});
    obstacles[0].track = &track;
    apply_assurance(assurance, kStart, obstacles);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Vec3 now = obstacles[0].alpha.of(track, k);
      EXPECT_LE(now.x(), before[k].x());
      EXPECT_GT(now.x(), 0.0);
      before[k] = now;
    }
  }
}

TEST(ReducedAssurances, CountThePromisedAlphaForAsLongAsItIsSure) {
  const Track track = new_thing(1, Vec3::Zero(), kStart);
  std::vector<PlanningObstacle> obstacles = obstacles_of({track});
  obstacles[0].track = &track;
  apply_assurance({0, 1.0, Duration{450'000}}, kStart, obstacles);
  for (std::size_t k = 0; k < track.alpha.size(); ++k) {
    EXPECT_EQ(obstacles[0].alpha.of(track, k), track.alpha[std::min<std::size_t>(k, 4)]) << k;
  }
}

TEST(ReducedAssurances, AreNeverMoreConfidentThanTheOneBefore) {
  double before = 1.0;
  for (const Assurance& assurance : reduced_assurances(kSideStepS)) {
    EXPECT_LE(confidence_of(assurance, 0.99), before);
    before = confidence_of(assurance, 0.99);
  }
  EXPECT_EQ(before, 0.0);
}

TEST(ConfidenceOf, IsThatOfTheSetsPromiseWhereANumberIsKnown) {
  EXPECT_EQ(confidence_of({}, 0.97), 0.97);
  EXPECT_EQ(confidence_of({2, 1.0, Duration{450'000}}, 0.97), kConfidenceLevels[2]);
  EXPECT_EQ(confidence_of({2, 1.0, Duration{450'000}}, 0.85), 0.85) << "no level lies above the promise";
  EXPECT_EQ(confidence_of({0, 1.0, Duration{0}}, 0.97), 0.0) << "sure for no time";
  EXPECT_EQ(confidence_of({kLevels - 1, 0.5, Duration{450'000}}, 0.97), 0.0);
}

TEST(ReducedAssurances, CountAlphaThatGrowsForTheTimeToStepAside) {
  const Track track = new_thing(1, Vec3::Zero(), kStart);
  std::vector<PlanningObstacle> obstacles = obstacles_of({track});
  obstacles[0].track = &track;
  for (const Assurance& assurance : reduced_assurances(kSideStepS)) {
    apply_assurance(assurance, kStart, obstacles);
    const AlphaShare& count = obstacles[0].alpha;
    const double last_s = kSideStepS - 0.05;  // in the last piece before
    EXPECT_GT(count.of(track, track.motion.locate(kStart + Duration::from_seconds(last_s)).index).x(),
              2.0 * count.of(track, 0).x());
  }
}

TEST_F(InACorridor, WhatIsPromisedIsFlownWhereThereIsRoom) {
  const Plan got = answer({believed_post(1, Vec3(1.8, 0, 1), 0.3)});
  EXPECT_EQ(got.outcome, PlanOutcome::Optimized);
  EXPECT_EQ(got.confidence, kConfidenceLevels[0]);
}

TEST_F(InACorridor, ThePlanIsOfTheGreatestConfidenceThatLeavesAWay) {
  // Beside the post 1.5 m − 0.3 m − α are left for the body of 0.2 m: not enough at levels 0 and 1.
  const Plan got = answer({believed_post(1, Vec3(1.8, 0, 1), 1.15)});
  EXPECT_EQ(got.outcome, PlanOutcome::Optimized);
  EXPECT_EQ(got.level, 2);
  EXPECT_EQ(got.confidence, kConfidenceLevels[2]);
  EXPECT_EQ(got.alpha_scale, 1.0);
}

TEST_F(InACorridor, WhatIsNewFarAheadLeavesAPlanThatIsSureForTheTimeToStepAside) {
  const Plan got = answer({new_thing(1, Vec3(6.5, 0, 1), request_.t_s)});
  EXPECT_EQ(got.outcome, PlanOutcome::Optimized);
  EXPECT_EQ(got.confidence, kConfidenceLevels[0]);
  EXPECT_LT(got.sure_for, kMaxSpan);
  EXPECT_GT(got.sure_for.seconds(), 0.1);
  EXPECT_GT(got.trajectory.control_points.row(0).maxCoeff(), 1.0);
}

TEST_F(InACorridor, WhoFliesBackBeforeWhatIsNewTurnsRoundWhileItIsFar) {
  const HorizonRequest back = request_at(request_.t_s, resting_at(Vec3(4, 0, 1), kStart));
  const PlanningWorld empty = world_of({}, go_to(Vec3(-4, 0, 1)), back);
  Budget budget = Budget::unlimited();
  const Plan retreat = plan(back, empty, PlannerConfig{}, budget).plan;
  ASSERT_EQ(retreat.outcome, PlanOutcome::Optimized);
  const Box corridor = request_.flight_box;
  request_ = request_at(request_.t_s + Duration{300'000}, retreat.trajectory);
  request_.flight_box = corridor;
  ASSERT_LT(request_.start.v.x(), -1.0);
  const Plan got = answer({new_thing(1, Vec3(8.5, 0, 1), request_.t_s)});
  EXPECT_EQ(got.outcome, PlanOutcome::Optimized);
  EXPECT_GT(got.trajectory.control_points.rightCols<1>().x(), request_.start.p.x());
}

TEST_F(InACorridor, WhoHasRestedOnTheWayForLongTakesWhatHasNoNumber) {
  Track post = believed_post(1, Vec3(1.52, 0, 1), 1.1);
  post.shares = {on_all_axes({1.0F, 1.0F, 1.0F, 1.0F})};
  const Plan at_first = answer({post});
  EXPECT_EQ(at_first.alpha_scale, 1.0);
  EXPECT_LT(at_first.trajectory.control_points.row(0).maxCoeff(), 0.1);
  const Box corridor = request_.flight_box;
  request_ = request_at(request_.t_s + Duration{2'000'000}, request_.committed);
  request_.flight_box = corridor;
  const Plan later = answer({post});
  EXPECT_EQ(later.outcome, PlanOutcome::Optimized);
  EXPECT_LT(later.alpha_scale, 1.0);
  EXPECT_EQ(later.confidence, 0.0);
  EXPECT_GT(later.trajectory.control_points.row(0).maxCoeff(), 1.0);
}

TEST_F(InACorridor, WhoMayStayWaitsTheLongerTheLessSureItIsToGo) {
  // A way is free at level 2; for a wider α only at level 4.
  const auto sets_out_after = [&](double alpha, double time_at_rest_s) {
    const Box corridor = request_.flight_box;
    request_ = request_at(rest_.end() + Duration::from_seconds(time_at_rest_s), rest_);
    request_.flight_box = corridor;
    return answer({believed_post(1, Vec3(1.8, 0, 1), alpha)}).trajectory.control_points.row(0).maxCoeff() > 1.0;
  };
  EXPECT_FALSE(sets_out_after(1.15, 0.05));
  EXPECT_TRUE(sets_out_after(1.15, 0.15));
  EXPECT_FALSE(sets_out_after(1.6, 0.35));
  EXPECT_TRUE(sets_out_after(1.6, 0.45));
}

TEST_F(InACorridor, WhatIsDeclaredIsCertainAtEveryLevel) {
  Track wall = believed_post(1, Vec3(1.8, 0, 1), 1.3);
  wall.kind = TrackKind::Declared;
  wall.shares.clear();
  const Plan got = answer({wall});
  EXPECT_EQ(got.level, 0);
  EXPECT_LT(got.trajectory.control_points.row(0).maxCoeff(), 1.8) << "nothing lies beyond";
}

TEST_F(InACorridor, WhoStandsInsideAnInflatedBoxFliesOutOfItAtWhatConfidenceThereIs) {
  const Plan got = answer({believed_post(1, Vec3(0.6, 0, 1), 1.4), believed_post(2, Vec3(-0.6, 0, 1), 1.4)});
  EXPECT_NE(got.outcome, PlanOutcome::NoPlan);
  EXPECT_LT(got.confidence, kConfidenceLevels[0]);
}

}  // namespace
}  // namespace tern
