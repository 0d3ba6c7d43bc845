#include "planner/schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "tests/support/plan_judge.h"

namespace tern {
namespace {

using namespace support;
using ::testing::ElementsAre;

constexpr UTime kStart{50'000'000};

/// A vehicle that has been at rest for half a second, beside one mover.
class ScheduleTest : public ::testing::Test {
 protected:
  /// @param alpha  of the mover, m; the start is relaxed from 0.5 m on
  std::vector<Trial> made(Task task, TrackKind kind, double alpha = 0.1) {
    Track mover = straight_mover(1, request_.start.p + Vec3(1, 0, 0), Vec3(0, 0.1, 0), 0.4, kStart, 8.0);
    mover.kind = kind;
    mover.alpha[0] = Vec3::Constant(alpha);
    if (kind == TrackKind::Estimated) mover.shares.push_back(on_all_axes({0.8F, 0.6F, 0.4F, 0.2F}));
    world_ = world_of({mover}, go_to(Vec3(10, 0, 1)), request_);
    near_.emplace(surroundings(request_, world_, config_, workspace_));
    return schedule(task, *near_);
  }

  static std::vector<Aim> aims(const std::vector<Trial>& trials) {
    std::vector<Aim> aims;
    for (const Trial& trial : trials) aims.push_back(trial.aim);
    return aims;
  }

  TimedSpline rest_ = resting_at(Vec3(0, 0, 1), kStart);
  HorizonRequest request_ = request_at(rest_.end() + Duration{500'000}, rest_);
  PlannerConfig config_;
  PlanWorkspace workspace_;
  PlanningWorld world_;
  std::optional<Surroundings> near_;
};

TEST_F(ScheduleTest, AmongDeclaredMoversSmallerStepsAndAnEvasionFollowTheGoal) {
  const TrackKind declared = TrackKind::Declared;
  EXPECT_THAT(aims(made(Task::Fly, declared)), ElementsAre(Aim::Goal, Aim::Step, Aim::Step, Aim::Step, Aim::Stop));
  EXPECT_THAT(aims(made(Task::Brake, declared)), ElementsAre(Aim::Goal, Aim::Stop));
  EXPECT_THAT(aims(made(Task::Blocked, declared)), ElementsAre(Aim::Stop));
  EXPECT_THAT(aims(made(Task::Stay, declared)), ElementsAre(Aim::Stop));
  for (const Trial& trial : made(Task::Fly, declared)) EXPECT_TRUE(is_full(trial.assurance));
}

TEST_F(ScheduleTest, ARelaxedStartSeeksRoomFirst) {
  for (const Task task : {Task::Fly, Task::Brake, Task::Blocked, Task::Stay}) {
    EXPECT_EQ(made(task, TrackKind::Declared, 0.7).front().aim, Aim::Room);
  }
  EXPECT_EQ(made(Task::Stay, TrackKind::Estimated, 0.7).front().aim, Aim::Room);
}

TEST_F(ScheduleTest, AmongEstimatesTheAssuranceFallsFromTrialToTrialAndAnEvasionEndsIt) {
  const std::vector<Trial> trials = made(Task::Fly, TrackKind::Estimated);
  ASSERT_EQ(trials.size(), 11U);
  EXPECT_EQ(trials.back().aim, Aim::Stop);
  EXPECT_TRUE(is_full(trials.front().assurance));
  EXPECT_TRUE(trials[1].is_first_reduced);
  for (std::size_t k = 1; k + 1 < trials.size(); ++k) {
    EXPECT_EQ(trials[k].aim, Aim::Goal);
    EXPECT_GE(trials[k].assurance.level, trials[k - 1].assurance.level);
    EXPECT_LE(trials[k].assurance.scale, trials[k - 1].assurance.scale);
    EXPECT_LE(trials[k].assurance.sure_for, trials[k - 1].assurance.sure_for);
    EXPECT_GE(trials[k].wait_s, trials[k - 1].wait_s) << "the vehicle waits the longer, the less sure it is";
    EXPECT_EQ(trials[k].needs_clear_start, k + 2 < trials.size());
  }
  EXPECT_EQ(trials[9].assurance.scale, trials.back().assurance.scale);
  EXPECT_EQ(trials[9].wait_s, kMaxWaitAtRest) << "a scaled α has no confidence";
}

TEST_F(ScheduleTest, AVehicleThatHasBeenAtRestSearchesEachDurationThoroughlyInTurn) {
  for (std::int64_t id = 1; id <= 20; ++id) {
    request_.id = id;
    for (const Trial& trial : made(Task::Fly, TrackKind::Estimated)) EXPECT_FALSE(trial.duration);
  }
  request_.t_s = rest_.end() + Duration::from_seconds(kMaxWaitAtRest) + Duration{1};
  const auto durations = static_cast<int>(config_.duration_scales.size());
  std::vector<int> turns(idx(durations + 1), 0);
  for (std::int64_t id = 1; id <= 2 * (durations + 1); ++id) {
    request_.id = id;
    const std::vector<Trial> trials = made(Task::Fly, TrackKind::Estimated);
    const Trial& reduced = trials[1];
    EXPECT_EQ(reduced.effort, reduced.duration ? Effort::Thorough : Effort::Reduced);
    EXPECT_EQ(effort_of(reduced.effort, SearchConfig{}).max_expansions,
              reduced.duration ? SearchConfig{}.max_expansions : kReducedExpansions);
    for (std::size_t k = 1; k + 1 < trials.size(); ++k) EXPECT_EQ(trials[k].duration, reduced.duration);
    EXPECT_FALSE(trials.front().duration) << "the full assurance is searched as ever";
    ++turns[idx(reduced.duration.value_or(durations))];
  }
  EXPECT_THAT(turns, ::testing::Each(2)) << "each duration, and all of them, have their turn";
}

TEST_F(ScheduleTest, AmongEstimatesARelaxedStartLeavesOutTheFullAssurance) {
  const std::vector<Trial> trials = made(Task::Fly, TrackKind::Estimated, 0.7);
  ASSERT_EQ(trials.size(), 10U);
  EXPECT_FALSE(is_full(trials.front().assurance));
}

TEST_F(ScheduleTest, AReducedEffortNeverRaisesAConfiguredLimit) {
  SearchConfig few;
  few.max_expansions = few.hold_expansions = 10;
  EXPECT_EQ(effort_of(Effort::Reduced, few).max_expansions, 10);
  EXPECT_EQ(effort_of(Effort::Reduced, few).hold_expansions, 10);
  EXPECT_EQ(effort_of(Effort::Reduced, SearchConfig{}).max_expansions, kReducedExpansions);
  EXPECT_EQ(effort_of(Effort::Full, SearchConfig{}).max_expansions, SearchConfig{}.max_expansions);
}

/// The value at full assurance stays as it is while others are made from it.
TEST_F(ScheduleTest, SurroundingsAtAnotherAssuranceAreANewValue) {
  (void)made(Task::Fly, TrackKind::Estimated, 0.7);
  const AlphaShare full = near_->obstacles.front().alpha;
  ASSERT_TRUE(near_->start.relaxed);
  for (const Assurance& assurance : reduced_assurances(near_->hold.side_step_s)) {
    const Surroundings reduced = at_assurance(assurance, *near_, workspace_);
    EXPECT_EQ(reduced.obstacles.front().alpha.level, assurance.level);
    EXPECT_EQ(near_->obstacles.front().alpha.level, full.level);
    EXPECT_EQ(near_->obstacles.front().alpha.scale, full.scale);
    EXPECT_TRUE(near_->start.relaxed);
    EXPECT_TRUE(is_full(near_->assurance));
  }
  EXPECT_EQ(&at_assurance({}, *near_, workspace_).obstacles, &near_->obstacles);
}

}  // namespace
}  // namespace tern
