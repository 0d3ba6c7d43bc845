#include "planner/preference.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/stop_rule.h"
#include "tests/support/plan_judge.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};

/// Candidates of a vehicle at rest at the origin whose local goal is at x = 3.
class Choice : public ::testing::Test {
 protected:
  Choice() { rest_for(0.5, TrackKind::Declared); }

  void rest_for(double seconds, TrackKind kind) {
    request_ = request_at(rest_.end() + Duration::from_seconds(seconds), rest_);
    Track mover = straight_mover(1, Vec3(0, 3, 1), Vec3(0, 0.1, 0), 0.4, kStart, 20.0);
    mover.kind = kind;
    if (kind == TrackKind::Estimated) {
      mover.alpha[0] = Vec3::Constant(0.1);
      mover.shares.push_back(on_all_axes({0.8F, 0.6F, 0.4F, 0.2F}));
    }
    world_ = world_of({mover}, go_to(Vec3(10, 0, 1)), request_);
    near_.emplace(surroundings(request_, world_, config_, workspace_));
  }

  /// A candidate that ends at x.
  [[nodiscard]] Candidate to(double x, bool holds, double arrival_s, double clear_s = 2.0) const {
    Candidate c;
    c.outcome = PlanOutcome::Optimized;
    c.trajectory = resting_at(Vec3(x, 0, 1), request_.t_s);
    c.holds = holds;
    c.arrival_s = arrival_s;
    c.clear_s = clear_s;
    c.progress = x / 3.0;
    c.approaches = x > kMinApproach;
    c.cost.distance_to_goal = 3.0 - x;
    return c;
  }
  [[nodiscard]] Candidate committed(bool holds, double arrival_s, double clear_s = 2.0) const {
    Candidate c = to(0.0, holds, arrival_s, clear_s);
    c.outcome = PlanOutcome::KeepCommitted;
    c.trajectory = rest_;
    return c;
  }

  TimedSpline rest_ = resting_at(Vec3(0, 0, 1), kStart);
  HorizonRequest request_;
  PlannerConfig config_;
  PlanWorkspace workspace_;
  PlanningWorld world_;
  std::optional<Surroundings> near_;
};

TEST_F(Choice, AHoldComesBeforeProgressAndProgressBeforeTheArrivalFromRest) {
  EXPECT_TRUE(is_better(to(0, true, 9), to(2, false, 1), *near_));
  EXPECT_TRUE(is_better(to(2, true, 9), to(0, true, 1), *near_));
  EXPECT_TRUE(is_better(to(1, true, 1), to(2, true, 2), *near_));
}

/// If two candidates could beat each other, the last one offered would win.
TEST_F(Choice, OfTwoCandidatesAtMostOneBeatsTheOther) {
  std::vector<Candidate> all;
  for (const double x : {0.0, 1.0, 2.0}) {
    for (const bool holds : {false, true}) {
      for (const double arrival_s : {1.0, 2.0}) all.push_back(to(x, holds, arrival_s));
    }
  }
  for (const Candidate& a : all) {
    EXPECT_FALSE(is_better(a, a, *near_));
    for (const Candidate& b : all) {
      EXPECT_FALSE(is_better(a, b, *near_) && is_better(b, a, *near_));
      for (const Candidate& c : all) {
        EXPECT_TRUE(!is_better(a, b, *near_) || !is_better(b, c, *near_) || is_better(a, c, *near_));
      }
    }
  }
}

TEST_F(Choice, AmongDeclaredMoversTheLongerClearTimeKeepsTheCommittedTrajectoryIfNeitherHolds) {
  EXPECT_TRUE(is_worse_than_committed(to(2, false, 1, 1.0), committed(false, 9, 2.0), *near_));
  EXPECT_FALSE(is_worse_than_committed(to(2, true, 1, 1.0), committed(true, 9, 2.0), *near_));
  rest_for(0.5, TrackKind::Estimated);
  EXPECT_FALSE(is_worse_than_committed(to(2, false, 1, 1.0), committed(false, 9, 2.0), *near_));
}

TEST_F(Choice, ADepartureFromRestMayArriveALittleLaterAndAfterASecondAsLateAsItLikes) {
  EXPECT_TRUE(replaces_committed(to(2, true, 5.04), committed(true, 5.0), *near_));
  EXPECT_FALSE(replaces_committed(to(2, true, 5.06), committed(true, 5.0), *near_));
  EXPECT_FALSE(replaces_committed(to(2, false, 5.04), committed(true, 5.0), *near_));
  rest_for(1.1, TrackKind::Declared);
  EXPECT_TRUE(replaces_committed(to(2, true, 50.0), committed(true, 5.0), *near_));
}

TEST_F(Choice, TheSameEndLaterIsNoDepartureButAnEvasionIsAlwaysFlown) {
  Candidate again = to(0, true, 4);
  EXPECT_FALSE(replaces_committed(again, committed(true, 5.0), *near_));
  again.outcome = PlanOutcome::Evade;
  EXPECT_TRUE(replaces_committed(again, committed(true, 5.0), *near_));
}

/// The stop rule, trial by trial.
class Stopping : public Choice {
 protected:
  /// An incumbent with these candidates.
  bool is_enough(const Trial& trial, const std::optional<Candidate>& best, const std::optional<Candidate>& committed,
                 Task task = Task::Fly) {
    return asked(best, committed, [&](const Incumbent& i) { return is_good_enough(i, trial, task, *near_); });
  }
  bool stays(const Trial& trial, const std::optional<Candidate>& committed) {
    return asked({}, committed, [&](const Incumbent& i) { return waits(i, trial, *near_); });
  }

  static constexpr Assurance kKnown{2, 1.0, Duration{400'000}};
  static constexpr Assurance kScaled{4, 0.6, Duration{400'000}};

  static Trial at(const Assurance& assurance, Aim aim = Aim::Goal, double wait_s = 0.0) {
    Trial trial;
    trial.aim = aim;
    trial.assurance = assurance;
    trial.wait_s = wait_s;
    return trial;
  }

 private:
  bool asked(const std::optional<Candidate>& best, const std::optional<Candidate>& committed, const auto& question) {
    PlanLog log(nullptr);
    Budget budget = Budget::unlimited();
    PlanTools tools{budget, workspace_, log};
    Incumbent incumbent(*near_, Plan{}, committed, tools);
    if (best) incumbent.offer(*best);
    return question(incumbent);
  }
};

TEST_F(Stopping, AQuarterOfTheWaySettlesTheAssuranceIfItHolds) {
  EXPECT_TRUE(is_enough(at(kKnown), to(1, true, 1), std::nullopt));
  EXPECT_TRUE(is_enough(at(kKnown), std::nullopt, to(1, true, 1)));
  EXPECT_FALSE(is_enough(at(kKnown), to(0.5, true, 1), std::nullopt));
  EXPECT_FALSE(is_enough(at(kKnown), to(1, false, 1), std::nullopt));
  EXPECT_FALSE(is_enough(at(kKnown), std::nullopt, std::nullopt));
}

TEST_F(Stopping, AScaledAlphaIsForAVehicleWithoutACandidateOrOneThatHasWaited) {
  EXPECT_FALSE(is_enough(at(kScaled, Aim::Goal, 1.0), std::nullopt, std::nullopt));
  EXPECT_TRUE(is_enough(at(kScaled, Aim::Goal, 1.0), std::nullopt, committed(true, 1)));
  EXPECT_FALSE(is_enough(at(kScaled, Aim::Goal, 0.4), std::nullopt, committed(true, 1)));
}

TEST_F(Stopping, AStationaryVehicleWhoseStopHoldsWaitsTheLongerTheLessSureItIs) {
  EXPECT_TRUE(stays(at(kKnown, Aim::Goal, 0.6), committed(true, 1)));
  EXPECT_FALSE(stays(at(kKnown, Aim::Goal, 0.4), committed(true, 1)));
  EXPECT_FALSE(stays(at(kKnown, Aim::Goal, 0.6), committed(false, 1)));
  EXPECT_FALSE(stays(at(kKnown, Aim::Goal, 0.6), std::nullopt));
  EXPECT_FALSE(stays(at({}, Aim::Goal, 0.6), committed(true, 1))) << "at full assurance it does not wait";
}

TEST_F(Stopping, NoEvasionIsSoughtWhileSomethingHoldsUnlessADeclaredMoverMeetsAVehicleAtItsGoal) {
  const Trial stop = at({}, Aim::Stop);
  EXPECT_TRUE(is_enough(stop, to(1, true, 1), std::nullopt));
  EXPECT_TRUE(is_enough(stop, std::nullopt, committed(true, 1), Task::Stay));
  EXPECT_FALSE(is_enough(stop, to(1, false, 1), committed(false, 1)));
  Candidate met = committed(true, 1);
  met.meets_declared = true;
  EXPECT_FALSE(is_enough(stop, std::nullopt, met, Task::Stay));
  EXPECT_TRUE(is_enough(stop, std::nullopt, met, Task::Fly));
  EXPECT_TRUE(is_enough(at(kScaled, Aim::Stop), std::nullopt, committed(false, 1)));
  EXPECT_FALSE(is_enough(at(kScaled, Aim::Stop), std::nullopt, std::nullopt));
}

TEST_F(Stopping, RoomEndsTheSearchForTheGoalAndProgressTheSmallerSteps) {
  Candidate room = to(0, true, 1);
  room.outcome = PlanOutcome::Evade;
  EXPECT_FALSE(is_enough(at({}, Aim::Room), std::nullopt, committed(true, 1)));
  EXPECT_TRUE(is_enough(at({}, Aim::Goal), room, std::nullopt));
  EXPECT_TRUE(is_enough(at({}, Aim::Step), room, std::nullopt));
  EXPECT_TRUE(is_enough(at({}, Aim::Step), to(0.1, false, 1), std::nullopt));
  EXPECT_FALSE(is_enough(at({}, Aim::Step), to(0, true, 1), std::nullopt));
}

}  // namespace
}  // namespace tern
