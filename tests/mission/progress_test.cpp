// Where a mission stands.
#include "mission/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/wire/message_limits.h"

namespace tern::mission {
namespace {

using ::testing::HasSubstr;

constexpr UTime kStart{1'800'000'000'000'000};

Mission three_steps() {
  return {"m.csv",
          {{"a", 1, Action::Pass, {10, 0, 2}, 2.0, 0.0, 0},
           {"b", 2, Action::Stop, {20, 0, 2}, 0.0, 3.0, 0},
           {"c", 3, Action::Stop, {30, 0, 2}, 0.0, 0.0, 0}}};
}

/// A mission and its vehicle, which is moved by the test.
class MissionProgress : public ::testing::Test {
 protected:
  explicit MissionProgress(Mission mission = three_steps()) : progress_(std::move(mission), {}, Limits()) {
    progress_.receive(at({0, 0, 2}), now_);
  }
  static UavState at(const Vec3& p, const Vec3& v = Vec3::Zero()) {
    UavState state;
    state.motion.p = p;
    state.motion.v = v;
    return state;
  }
  /// The vehicle follows from the beginning, and the first goal is sent.
  void begin() {
    progress_.set_following(true, now_);
    progress_.start({}, {}, now_);
    (void)goal();
  }
  std::optional<Goal> goal() {
    auto goal = progress_.due(now_);
    if (goal) newest_ = *goal;
    return goal;
  }
  void state(const Vec3& p, const Vec3& v = Vec3::Zero()) { progress_.receive(at(p, v), now_); }
  void wait(double seconds) { now_ = now_ + Duration::from_seconds(seconds); }
  /// A goal of an operator.
  void order(GoalMode mode, const Vec3& p = Vec3::Zero()) {
    Goal goal;
    goal.id = newest_.id + 100'000 + ++orders_;
    goal.mode = mode;
    goal.position = p;
    progress_.receive(goal, now_);
  }

  Progress progress_;
  UTime now_ = kStart;
  Goal newest_;
  int orders_ = 0;
};

TEST_F(MissionProgress, HoldsUntilTheVehicleFollows) {
  progress_.start({}, {}, now_);
  EXPECT_EQ(goal()->mode, GoalMode::Hold);
  EXPECT_EQ(progress_.stand(), Stand::Waiting);
  progress_.set_following(true, now_);
  EXPECT_EQ(goal()->position, Vec3(10, 0, 2));
}

TEST_F(MissionProgress, RepeatsItsGoalEverySecond) {
  begin();
  EXPECT_FALSE(goal());
  wait(1.0);
  const Goal before = newest_;
  EXPECT_EQ(goal()->id, before.id);
}

TEST_F(MissionProgress, PassesWithoutAStopAndStaysAtAStop) {
  begin();
  state({7.7, 0, 2}, {4, 0, 0});  // 2.3 m away at 4 m/s: within the radius after kGoalLatency
  EXPECT_EQ(goal()->position, Vec3(20, 0, 2));
  EXPECT_FALSE(progress_.reached()[0].has_value());
  state({8.1, 0, 2}, {4, 0, 0});
  EXPECT_TRUE(progress_.reached()[0].has_value());
  state({20, 0.1, 2});
  EXPECT_EQ(progress_.stand(), Stand::Staying);
  wait(2.9);
  state({20, 0.1, 2});
  EXPECT_EQ(progress_.step(), 1);
  wait(0.2);
  state({20, 0.1, 2});
  EXPECT_EQ(goal()->position, Vec3(30, 0, 2));
  state({30, 0, 2});
  state({30, 0, 2});
  EXPECT_EQ(progress_.stand(), Stand::Done);
}

TEST_F(MissionProgress, FliesBackToAWaypointThatWasMissed) {
  begin();
  state({9.5, 2.0, 2}, {6, 0, 0});
  EXPECT_EQ(goal()->position, Vec3(20, 0, 2));
  state({10.1, 2.1, 2}, {6, 0, 0});  // behind it, 2.1 m away
  EXPECT_EQ(goal()->position, Vec3(10, 0, 2));
  EXPECT_EQ(progress_.repeats(), 1);
  state({9.0, 2.05, 2}, {0, -4, 0});
  EXPECT_EQ(progress_.step(), 0);  // this time only within the radius
  state({9.5, 1.0, 2}, {0, -4, 0});
  EXPECT_EQ(progress_.step(), 1);
}

TEST_F(MissionProgress, AHoldPausesAndADetourResumes) {
  begin();
  order(GoalMode::Hold);
  EXPECT_EQ(progress_.stand(), Stand::Paused);
  EXPECT_FALSE(goal());
  state({10, 0, 2});
  EXPECT_EQ(progress_.step(), 0);
  order(GoalMode::Go, {5, 5, 2});
  state({1, 1, 2}, {3, 0, 0});
  EXPECT_EQ(progress_.stand(), Stand::Paused);
  state({5, 5, 2});
  EXPECT_EQ(progress_.stand(), Stand::Flying);
  EXPECT_EQ(goal()->position, Vec3(10, 0, 2));
}

TEST_F(MissionProgress, SendsNothingNewWhileAPilotFlies) {
  begin();
  const Goal before = newest_;
  progress_.set_following(false, now_);
  state({10, 0, 2});
  wait(1000.0);
  state({20, 0, 2});
  EXPECT_EQ(goal()->id, before.id);
  progress_.set_following(true, now_);
  state({15, 0, 2});
  EXPECT_EQ(progress_.stand(), Stand::Flying);  // the time with the pilot does not count
  EXPECT_EQ(progress_.step(), 0);
}

TEST_F(MissionProgress, ANewProcessGoesOnAtTheVehiclesGoal) {
  begin();
  state({9, 0, 2}, {4, 0, 0});
  (void)goal();
  ASSERT_EQ(newest_.position, Vec3(20, 0, 2));
  Progress again(three_steps(), {}, Limits());
  again.set_following(true, now_);
  again.start(newest_, {}, now_);
  EXPECT_EQ(again.step(), 1);
  const auto goal = again.due(now_);
  EXPECT_EQ(goal->position, newest_.position);
  EXPECT_GT(goal->id, newest_.id);
}

TEST_F(MissionProgress, ANewProcessBeginsAnewAfterAnotherMissionsGoal) {
  Goal other;
  other.id = goal_id(1, now_, 0);
  other.position = Vec3(1, 2, 3);
  progress_.set_following(true, now_);
  progress_.start(other, {}, now_);
  EXPECT_EQ(progress_.step(), 0);
  EXPECT_GT(goal()->id, other.id);
}

TEST_F(MissionProgress, ANewProcessStaysPausedByAnOrder) {
  begin();
  state({8.5, 0, 2}, {4, 0, 0});
  progress_.pause(now_);
  (void)goal();
  Remembered remembered;
  remembered.step = 1;
  remembered.is_paused = true;
  remembered.reached.resize(3);
  Progress again(three_steps(), {}, Limits());
  again.set_following(true, now_);
  again.start(newest_, remembered, now_);
  EXPECT_EQ(again.stand(), Stand::Paused);
  EXPECT_EQ(again.due(now_)->mode, GoalMode::Hold);
  EXPECT_TRUE(again.go_on(now_));
  EXPECT_EQ(again.due(now_)->position, Vec3(20, 0, 2));
}

TEST_F(MissionProgress, ANewProcessFliesNothingOfAMissionThatHasEnded) {
  Goal other;
  other.id = goal_id(kNoStep, now_, 0) - 1;
  other.position = Vec3(5, 5, 5);
  Remembered remembered;
  remembered.step = 2;
  remembered.ended = Stand::Failed;
  remembered.text = "c was not reached";
  remembered.reached.resize(3);
  progress_.set_following(true, now_);
  progress_.start(other, remembered, now_);
  state(other.position);
  EXPECT_FALSE(goal());
  EXPECT_EQ(progress_.stand(), Stand::Failed);
  EXPECT_EQ(progress_.text(), remembered.text);
}

TEST_F(MissionProgress, AnOrderPausesAndResumes) {
  begin();
  EXPECT_TRUE(progress_.pause(now_));
  EXPECT_EQ(goal()->mode, GoalMode::Hold);
  state({10, 0, 2});
  EXPECT_EQ(progress_.stand(), Stand::Paused);
  EXPECT_TRUE(progress_.go_on(now_));
  EXPECT_EQ(goal()->position, Vec3(10, 0, 2));
  EXPECT_FALSE(progress_.go_on(now_));
}

TEST_F(MissionProgress, ANewProcessStaysPaused) {
  Goal other;
  other.id = goal_id(1, now_, 0);
  other.mode = GoalMode::Stop;
  progress_.set_following(true, now_);
  Remembered remembered;
  remembered.step = 2;
  remembered.reached.resize(3);
  progress_.start(other, remembered, now_);
  EXPECT_EQ(progress_.stand(), Stand::Paused);
  EXPECT_EQ(progress_.step(), 2);
}

TEST_F(MissionProgress, TheTimeOfAStepCountsFromWhereAPilotLeftTheVehicle) {
  begin();
  progress_.set_following(false, now_);
  state({300, 0, 2});
  progress_.set_following(true, now_);
  wait(time_limit_s({0, 0, 2}, {10, 0, 2}, Limits()) + 1.0);
  state({100, 0, 2}, {-6, 0, 0});
  EXPECT_EQ(progress_.stand(), Stand::Flying);
}

TEST_F(MissionProgress, FailsWhenAStepTakesTooLong) {
  begin();
  wait(time_limit_s({0, 0, 2}, {10, 0, 2}, Limits()) + 1.0);
  state({1, 0, 2});
  EXPECT_EQ(progress_.stand(), Stand::Failed);
  EXPECT_THAT(progress_.text(), HasSubstr("a was not reached within"));
  EXPECT_EQ(goal()->mode, GoalMode::Hold);
}

class FollowingMission : public MissionProgress {
 protected:
  FollowingMission() : MissionProgress({"m.csv", {{"f", 1, Action::Follow, {-3, 0, 1}, 0.0, 10.0, 7}}}) {}
};

TEST_F(FollowingMission, KeepsBesideTheTrackForItsTime) {
  begin();
  EXPECT_EQ(newest_.mode, GoalMode::Hold);  // until the track is received
  for (int k = 0; k < 120 && progress_.stand() != Stand::Done; ++k) {
    progress_.receive_track({4.0 * 0.1 * k, 0, 0}, now_);
    state({4.0 * 0.1 * k - 4.0, 0, 1});
    const auto sent = goal();
    const bool is_go = sent && sent->mode == GoalMode::Go;
    EXPECT_NEAR(is_go ? sent->position.x() : 4.0 * 0.1 * k - 3.0, 4.0 * 0.1 * k - 3.0, 0.9);
    wait(0.1);
  }
  EXPECT_EQ(progress_.stand(), Stand::Done);
}

TEST_F(FollowingMission, FailsWhenTheTrackIsLost) {
  begin();
  progress_.receive_track({4, 0, 0}, now_);
  wait(5.1);
  state({0, 0, 2});
  EXPECT_EQ(progress_.stand(), Stand::Failed);
  EXPECT_THAT(progress_.text(), HasSubstr("track 7 was not in PREDICTIONS for 5 s"));
}

TEST(VelocityLimits, AreTheSpeedOnTheStraightWayAndNeverAboveTheVehicles) {
  Limits limits;
  limits.v_max = Vec3(6, 6, 2);
  for (double angle = 0.0; angle < 6.3; angle += 0.1) {
    const Vec3 way(std::cos(angle), std::sin(angle), 0.3);
    const Vec3 v = velocity_limits(3.0, Vec3(1, 2, 3), Vec3(1, 2, 3) + 20.0 * way, limits);
    const Eigen::Vector2d d = way.head<2>().cwiseAbs();
    EXPECT_GE((v.head<2>().array() - 3.0 * d.array()).minCoeff(), -1e-12) << "the straight way is flown at 3 m/s";
    EXPECT_LE(v.head<2>().norm(), 3.0 * std::sqrt(1.5) + 1e-12);
    EXPECT_EQ(v.z(), 2.0);
  }
  EXPECT_EQ(velocity_limits(50.0, Vec3::Zero(), Vec3::UnitX(), limits), limits.v_max);
  EXPECT_NEAR(velocity_limits(1.0, Vec3::Zero(), Vec3::UnitZ(), limits).x(), std::sqrt(0.5), 1e-12);
}

class SlowMission : public MissionProgress {
 protected:
  static Mission slow_at_last() {
    Mission mission = three_steps();
    mission.steps[2].speed = 1.5;
    return mission;
  }
  SlowMission() : MissionProgress(slow_at_last()) {}
};

TEST_F(SlowMission, SendsTheSpeedOfAStepWithItsGoal) {
  begin();
  EXPECT_FALSE(progress_.speed_limit());
  state({10, 0, 2}, {5, 0, 0});
  state({20, 0, 2});
  wait(3.1);
  state({20, 0, 2});
  ASSERT_TRUE(goal());
  ASSERT_TRUE(progress_.speed_limit());
  EXPECT_EQ(progress_.speed_limit()->goal_id, newest_.id);
  EXPECT_EQ(progress_.speed_limit()->v_max.x(), 1.5);
  ASSERT_TRUE(progress_.pause(now_));
  EXPECT_FALSE(progress_.speed_limit());
  ASSERT_TRUE(progress_.go_on(now_));
  EXPECT_TRUE(progress_.speed_limit());
}

TEST(GoalIds, AscendAndCarryTheStep) {
  std::int64_t largest = 0;
  UTime now = kStart;
  for (int k = 0; k < 3 * kMaxSteps; ++k) {
    const int step = (k * 7) % kMaxSteps;
    const std::int64_t id = goal_id(step, now, largest);
    ASSERT_GT(id, largest);
    ASSERT_EQ(step_of(id), step);
    ASSERT_LE(id, now.us + 8192);
    largest = id;
    now = now + Duration{10'000};
  }
  EXPECT_EQ(step_of(goal_id(5, UTime{1'000'000}, 1)), 5);
  EXPECT_GT(goal_id(0, UTime{1}, 10'000'000), 10'000'000);
  for (const int step : {0, kMaxSteps - 1}) {
    const std::int64_t id = goal_id(step, UTime{1}, kMaxGoalId);
    EXPECT_GT(id, kMaxGoalId) << "a number after the largest legal one";
    EXPECT_EQ(step_of(id), step);
  }
}

}  // namespace
}  // namespace tern::mission
