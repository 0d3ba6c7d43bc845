// Made-up flights: the sentence names the cause that held the vehicle, its time, the evidence and a remedy.
#include "monitor/flight_cause.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace tern {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

constexpr UTime kZero{1'000'000'000};
const Vec3 kStart(0, 0, 1), kGoal(10, 0, 1);

UTime at(double s) { return kZero + Duration::from_seconds(s); }

/// A flight of messages every 50 ms: the vehicle flies along x from kStart.
class Story {
 public:
  /// Requests, answers and states of [from_s, to_s); `answer` changes the answer to each request.
  Story& fly(double from_s, double to_s, double speed, const std::function<void(Plan&)>& answer = {}) {
    for (double s = from_s; s < to_s - 1e-9; s += 0.05) {
      x_ += speed * 0.05;
      UavState state;
      state.header.utime = state.at = at(s);
      state.motion.p = kStart + Vec3(x_, 0, 0);
      state.motion.v = Vec3(speed, 0, 0);
      evidence.receive(state);
      HorizonRequest request = request_;
      request.start.p = state.motion.p;
      request.header.utime = at(s);
      request.id = ++id_;
      request.deadline = at(s + 0.07);
      evidence.receive(request);
      Plan plan;
      plan.request_id = id_;
      plan.header.utime = at(s + 0.02);
      plan.outcome = PlanOutcome::Optimized;
      if (answer) answer(plan);
      if (plan.request_id > 0) evidence.receive(plan);
    }
    return *this;
  }
  Story& fly_with(double from_s, double to_s, double speed, PlanReason reason) {
    return fly(from_s, to_s, speed, [reason](Plan& plan) {
      plan.outcome = PlanOutcome::NoPlan;
      plan.reason = reason;
    });
  }
  Story& beat(const std::string& process, double s, ProcessState state = ProcessState::Ready,
              const std::string& text = "") {
    Heartbeat heartbeat;
    heartbeat.header.utime = at(s);
    heartbeat.process = process;
    heartbeat.state = state;
    heartbeat.waiting_for = text;
    evidence.receive(heartbeat);
    return *this;
  }
  Story& status(double s, bool following, const std::string& why_not = "", const std::string& mode = "OFFBOARD") {
    VehicleStatus status;
    status.header.utime = status.at = at(s);
    status.following = following;
    status.why_not = why_not;
    status.mode = mode;
    evidence.receive(status);
    return *this;
  }
  /// A set of predictions with track 7 at p.
  Story& predict(double s, const Vec3& p) {
    TrackSet set;
    set.batch.set = ++set_;
    set.made_at = at(s);
    Track track;
    track.id = 7;
    track.kind = TrackKind::Estimated;
    track.half_extents = Vec3::Constant(0.3);
    CubicPiece piece{Duration{1'000'000}, PowerCubic::Zero()};
    piece.coefficients.col(3) = p;
    track.motion = {set.made_at, {piece}};
    track.alpha = {Vec3::Constant(0.1)};
    set.tracks = {track};
    evidence.receive(set);
    return *this;
  }
  HorizonRequest& request() { return request_; }

  [[nodiscard]] Explanation timeout() const {
    return explain(evidence, {FlightOutcome::Timeout, "9.00 m from the goal after 12.00 s", {}, 1.0});
  }

  FlightEvidence evidence{kStart, kGoal};

 private:
  HorizonRequest request_ = [] {
    HorizonRequest request;
    request.flight_box = Box(Vec3(-20, -20, -20), Vec3(20, 20, 20));
    request.body.radius = 0.4;
    return request;
  }();
  std::int64_t id_ = 0, set_ = 0;
  double x_ = 0.0;
};

TEST(FlightCause, OfAFlightThatReachedItsGoalIsNone) {
  Story story;
  story.fly(0, 5, 2.0);
  const Explanation none = explain(story.evidence, {FlightOutcome::Reached, ""});
  EXPECT_EQ(none.cause, Cause::None);
  EXPECT_EQ(none.sentence, "");
}

TEST(FlightCause, OfAStaleWorldNamesSinceWhenHowOftenHowLateAndTheLimit) {
  Story story;
  TrackSet predictions;
  predictions.made_at = at(3.5);
  story.fly(0, 4, 0.5);
  story.evidence.receive(predictions);
  ObservationSet frame;
  frame.at = at(3.5);
  frame.header.utime = at(3.78);
  story.evidence.receive(frame);
  story.fly_with(4, 12, 0.0, PlanReason::StaleWorld);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::StaleWorld);
  EXPECT_THAT(why.sentence, AllOf(HasSubstr("stood since 4.0 s"), HasSubstr("160 answers *stale world*"),
                                  HasSubstr("sensor 0.28 s late, limit 0.3"), HasSubstr("planner.stale_after_s")));
}

TEST(FlightCause, OfAStaleWorldTakesTheLimitOfTheScenario) {
  Story story;
  ConfigurationReport report;
  report.yaml = "planner:\n  stale_after_s: 0.5\n";
  story.evidence.receive(report);
  TrackSet predictions;
  predictions.made_at = at(3.5);
  story.fly(0, 4, 0.5);
  story.evidence.receive(predictions);
  story.fly_with(4, 12, 0.0, PlanReason::StaleWorld);
  EXPECT_THAT(story.timeout().sentence, AllOf(HasSubstr("limit 0.5"), HasSubstr("tern-predictor ceased")));
}

TEST(FlightCause, OfMissingPredictionsAsksForThePredictor) {
  Story story;
  story.fly(0, 2, 0.0).fly_with(2, 12, 0.0, PlanReason::StaleWorld);
  EXPECT_THAT(story.timeout().sentence, HasSubstr("no PREDICTIONS came"));
}

TEST(FlightCause, OfMissingPredictionsRepeatsThatTheirSenderIsOverloaded) {
  const std::string words = "sensor 1: overloaded, sets are skipped for newer ones";
  Story story;
  story.fly(0, 2, 0.0).fly_with(2, 12, 0.0, PlanReason::StaleWorld);
  story.beat("tern-predictor", 11.5, ProcessState::Ready, words);
  EXPECT_THAT(story.timeout().sentence, HasSubstr("no PREDICTIONS came; tern-predictor: " + words));
  Story waiting;
  waiting.beat("tern-planner", 3, ProcessState::Waiting, "predictions");
  waiting.beat("tern-predictor", 4, ProcessState::Ready, words);
  EXPECT_THAT(explain(waiting.evidence, {FlightOutcome::Failed, ""}).sentence,
              HasSubstr("tern-planner (predictions); tern-predictor: " + words));
}

TEST(FlightCause, OfAStateThatDoesNotChangeBlamesItsSenderAndNotTheTube) {
  Story story;
  story.fly(0, 4, 0.5);
  const UavState last = *story.evidence.state();
  story.request().tube = Vec3::Constant(2.0);
  for (double s = 4; s < 12; s += 0.05) {
    UavState same = last;
    same.header.utime = same.at = at(s);
    story.evidence.receive(same);
  }
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::StateRefused);
  EXPECT_THAT(why.sentence, HasSubstr("UAV_STATE has had one position and velocity since 3.9 s"));
}

TEST(FlightCause, OfAGoalOutsideTheBoxLessTheTubeSaysSo) {
  Story story;
  story.request().flight_box = Box(Vec3(-20, -20, -20), Vec3(11, 20, 20));
  story.request().tube = Vec3(1.4, 0.1, 0.1);
  story.fly(0, 4, 0.5).fly_with(4, 12, 0.0, PlanReason::GoalBlocked);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::GoalBlocked);
  EXPECT_THAT(why.sentence, HasSubstr("the goal (10.00, 0.00, 1.00) m is inside the box, but not inside the box less a "
                                      "tube of 1.4 m"));
  story.request().flight_box.max().x() = 10.2;
  story.fly_with(12, 20, 0.0, PlanReason::GoalBlocked);
  EXPECT_THAT(story.timeout().sentence, HasSubstr("not inside the flight box less the body"));
}

TEST(FlightCause, OfABlockedGoalRepeatsWhatThePlannerFound) {
  Story story;
  story.fly(0, 4, 0.5).fly_with(4, 12, 0.0, PlanReason::GoalBlocked);
  EXPECT_THAT(story.timeout().sentence, HasSubstr("map and obstacles leave no way"));
  story.beat("tern-planner", 11.9, ProcessState::Ready,
             "goal 1 is blocked: obstacle 'gate' is the first to block the way");
  EXPECT_THAT(story.timeout().sentence, HasSubstr("goal 1 is blocked: obstacle 'gate' is the first to block the way"));
}

TEST(FlightCause, OfNoPlanNamesTheCommonestReasonAndTheTube) {
  Story story;
  story.request().tube = Vec3::Constant(0.3);
  story.fly(0, 4, 0.5).fly_with(4, 12, 0.0, PlanReason::Infeasible);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::NoPlan);
  EXPECT_THAT(why.sentence, AllOf(HasSubstr("160 answers *infeasible*"), HasSubstr("tube of 0.3 m")));
}

TEST(FlightCause, OfAStartThatTheTubeCoversNamesTheTube) {
  Story story;
  story.fly_with(4, 12, 0.0, PlanReason::StartInCollision);
  EXPECT_THAT(story.timeout().sentence,
              AllOf(HasSubstr("160 answers *start in collision*"),
                    HasSubstr("came and went, covers the body; with planner.unknown: obstacle")));
  Story tubed;
  tubed.request().tube = Vec3::Constant(0.3);
  tubed.fly_with(4, 12, 0.0, PlanReason::StartInCollision);
  EXPECT_THAT(tubed.timeout().sentence, HasSubstr("a smaller executor.tube_m"));
}

TEST(FlightCause, OfAStartThatAPredictionCoversNamesTheTrack) {
  Story story;
  story.predict(4.0, kStart + Vec3(0.5, 0, 0)).fly_with(4, 8, 0.0, PlanReason::StartInCollision);
  for (int k = 0; k < 20; ++k) story.predict(8.0 + 0.1 * k, kStart + Vec3(0.5, 0, 0));
  story.fly_with(8, 12, 0.0, PlanReason::StartInCollision);
  EXPECT_THAT(story.timeout().sentence,
              HasSubstr("a detected obstacle (track 7), with its error bound, covers the body"));
}

TEST(FlightCause, OfAGoalWhereAnObstacleStandsNamesTheTrack) {
  Story story;
  const auto keep = [](Plan& plan) { plan.outcome = PlanOutcome::KeepCommitted; };
  story.fly(0, 4, 0.5).fly(4, 12, 0.0, keep);
  EXPECT_THAT(story.timeout().sentence,
              HasSubstr("160 of 160 answers stayed or evaded, as no plan made more progress"));
  for (int k = 0; k < 20; ++k) story.predict(12.0 + 0.1 * k, kGoal);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::GoalBlocked);
  EXPECT_THAT(why.sentence, HasSubstr("a detected obstacle (track 7) was at the goal in 20 of 20 predictions"));
}

TEST(FlightCause, OfAVehicleThatDoesNotHoldItsSetpointsIsNotItsEstimate) {
  Story story;
  story.fly(0, 19, 0.5).fly_with(19, 30, 0.0, PlanReason::AtGoal);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::NotFollowing);
  EXPECT_THAT(why.sentence, HasSubstr("its setpoints rest at the goal, and it does not"));
}

TEST(FlightCause, OfALiveMapThatIsOldSaysThatScansMustComeAgain) {
  Story story;
  story.fly(0, 6, 0.5).fly(6, 12, 0.0);
  story.beat("tern-executor", 11.9, ProcessState::Waiting,
             "the live map is not kept up to date: tern-mapper waits for scans: the last usable one came 5 s ago");
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::StaleWorld);
  EXPECT_THAT(why.sentence, HasSubstr("came 5 s ago; scans must come again"));
}

TEST(FlightCause, OfAnExecutorThatGaveUpDoesNotAskForOtherStates) {
  Story story;
  story.fly(0, 6, 0.5).fly(6, 12, 0.0);
  story.beat("tern-executor", 11.9, ProcessState::Failed, "the vehicle does not follow its setpoints");
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::NotFollowing);
  EXPECT_THAT(why.sentence, Not(HasSubstr("must send sound ones")));
}

TEST(FlightCause, OfASlowMachineNamesAPaceThatIsHalfAsFast) {
  Story story;
  story.fly(0, 4, 0.5);
  PlanTiming timing;
  timing.total_ms = 71.0;
  for (int k = 0; k < 100; ++k) story.evidence.receive(timing);
  story.fly(4, 12, 0.0, [](Plan& plan) {
    plan.header.utime = plan.header.utime + Duration{80'000};
    plan.outcome = PlanOutcome::NoPlan;
  });
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::TooSlow);
  EXPECT_THAT(why.sentence, AllOf(HasSubstr("the machine was too slow: 160 of 160 answers late"),
                                  HasSubstr("(p50 71 ms, allowed 70): --pace 0.5")));
  const FlightEnd slowed{FlightOutcome::Timeout, "", {}, 0.5};
  EXPECT_THAT(explain(story.evidence, slowed).sentence, HasSubstr("allowed 140): --pace 0.25"));
  const FlightEnd by_autopilot{FlightOutcome::Timeout, "", {}, std::nullopt};
  EXPECT_THAT(explain(story.evidence, by_autopilot).sentence, Not(HasSubstr("--pace"))) << "its clock cannot be slowed";
}

TEST(FlightCause, OfAnswersThatNeverCameIsTheSameSlowness) {
  Story story;
  story.fly(0, 4, 0.5).fly(4, 12, 0.0, [](Plan& plan) { plan.request_id = 0; });
  EXPECT_EQ(story.timeout().cause, Cause::TooSlow);
}

TEST(FlightCause, ARequestThatIsDeliveredAgainIsNotUnanswered) {
  Story story;
  story.fly(0, 4, 0.5);
  const std::size_t answered = story.evidence.answers().size();
  story.evidence.receive(HorizonRequest(*story.evidence.last_request()));
  story.fly(4, 5, 0.5);
  EXPECT_EQ(story.evidence.answers().size(), answered + 20);
}

TEST(FlightCause, OfADeadProcessNamesItAndWhenItWasHeardLast) {
  Story story;
  for (double s = 0; s < 4; s += 0.5) story.beat("tern-planner", s).beat("tern-executor", s);
  story.fly(0, 4, 0.5).fly(4, 12, 0.0, [](Plan& plan) { plan.request_id = 0; });
  for (double s = 4; s < 12; s += 0.5) story.beat("tern-executor", s);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::ProcessSilent);
  EXPECT_THAT(why.sentence, HasSubstr("tern-planner was silent from 3.5 s on"));
}

TEST(FlightCause, TheSenderOfTheVerdictWasNotSilent) {
  Story story;
  story.beat("tern-simulator", 1.0).fly(0, 12, 0.5);
  FlightEnd end{FlightOutcome::Timeout, "", {}, 1.0};
  EXPECT_EQ(explain(story.evidence, end).cause, Cause::ProcessSilent);
  end.result.emplace();
  EXPECT_EQ(explain(story.evidence, end).cause, Cause::TimeTooShort);
}

TEST(FlightCause, OfAPilotWhoTookOverIsToldAsTheBridgeSaysIt) {
  Story story;
  story.fly(0, 12.6, 0.5).status(0, true).status(12.6, false, "stood back: the pilot took over (POSCTL)", "POSCTL");
  story.fly(12.6, 20, 0.0).status(19.9, false, "stood back: the pilot took over (POSCTL)", "POSCTL");
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::NotFollowing);
  EXPECT_THAT(why.sentence, AllOf(HasSubstr("stood back at 12.6 s"), HasSubstr("the pilot took over (POSCTL)"),
                                  HasSubstr("a new GOAL orders it to fly on")));
}

TEST(FlightCause, OfAVehicleThatFollowsAgainIsNotThatItDidNot) {
  Story story;
  story.fly(0, 4, 0.5).status(0, true).status(2, false, "stood back: x").status(3, true);
  story.fly_with(4, 12, 0.0, PlanReason::Infeasible);
  EXPECT_EQ(story.timeout().cause, Cause::NoPlan);
}

TEST(FlightCause, ThatTheVerdictEndsTheFollowingIsNoCause) {
  Story story;
  story.fly(0, 10, 0.5).status(0, true).status(10, false, "the flight has ended");
  EXPECT_EQ(story.timeout().cause, Cause::TimeTooShort);
}

TEST(FlightCause, OfALostEstimateSaysThatTheFlightWaitsForIt) {
  Story story;
  story.fly(0, 6, 0.5).status(0, true);
  story.status(6, false, "its estimator has no position (ESTIMATOR_STATUS)").fly(6, 12, 0.0);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::EstimateLost);
  EXPECT_THAT(why.sentence, HasSubstr("lost its position at 6.0 s"));
}

TEST(FlightCause, OfARefusedStateRepeatsWhatTheExecutorSays) {
  Story story;
  story.fly(0, 6, 0.5).status(0, true);
  story.beat("tern-executor", 6.0, ProcessState::Waiting, "UAV_STATE is 0.4 s old (refused: number)");
  story.fly(6, 12, 0.0).beat("tern-executor", 11.9, ProcessState::Waiting, "UAV_STATE is 0.4 s old (refused: number)");
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::StateRefused);
  EXPECT_THAT(why.sentence, HasSubstr("from 6.0 s on: UAV_STATE is 0.4 s old (refused: number)"));
}

TEST(FlightCause, OfAFlightThatNeverBeganNamesWhatItWaitedFor) {
  FlightEvidence evidence(kStart, kGoal);
  const std::string refused = "tern-predictor (30/s refused: detections[1].position.x is nan)";
  const Explanation why = explain(evidence, {FlightOutcome::Failed, "not ready after 15 s: " + refused});
  EXPECT_EQ(why.cause, Cause::NeverBegan);
  EXPECT_EQ(why.sentence, "the flight never began: not ready after 15 s: " + refused);
  Story waiting;
  waiting.beat("tern-mapper", 1.0, ProcessState::Waiting, "its map");
  EXPECT_EQ(waiting.timeout().sentence, "the flight never began: tern-mapper (its map)");
}

TEST(FlightCause, ARefusalGetsNoHintOfWhatOthersWaitFor) {
  Story story;
  story.beat("tern-predictor", 1.0, ProcessState::Waiting, "obstacle observations");
  EXPECT_THAT(story.timeout().sentence, HasSubstr("a detector or a sensor of the scenario"));
  EXPECT_EQ(explain(story.evidence, {FlightOutcome::Failed, "tern-mission: a photo"}).sentence,
            "the flight never began: tern-mission: a photo");
}

TEST(FlightCause, OfAVehicleOnItsWayIsHowMuchMoreTimeItNeeds) {
  Story story;
  story.fly(0, 10, 0.5);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::TimeTooShort);
  EXPECT_THAT(why.sentence,
              MatchesRegex("was on its way, 5.0 m from the goal at 0.5 m/s on average: about 1[01] s more "
                           "would do \\(timeout_s\\)"));
}

TEST(FlightCause, OfOnesThatMoveWithoutComingNearerIsNotTheTime) {
  Story story;
  story.fly(0, 4, 1.0);
  for (double s = 4; s < 12; s += 2) story.fly(s, s + 1, 1.0).fly(s + 1, s + 2, -1.0);
  const Explanation why = story.timeout();
  EXPECT_EQ(why.cause, Cause::NoProgress);
  EXPECT_THAT(why.sentence, HasSubstr("came no nearer since "));
}

TEST(FlightCause, OfAContactNamesWithWhatWhenHowFastAndWhatThePlannerAnsweredBefore) {
  Story story;
  story.fly(0, 4, 2.0).fly_with(4, 5.2, 2.0, PlanReason::StaleWorld);
  FlightResult result;
  result.contacts_moving = 1;
  const FlightEnd end{FlightOutcome::Collision, "touched obstacle 3 'gate' at 5.213 s, position P", result};
  const Explanation why = explain(story.evidence, end);
  EXPECT_EQ(why.cause, Cause::Contact);
  EXPECT_THAT(why.sentence,
              MatchesRegex("touched obstacle 3 'gate' at 5.213 s, position P, flying at 2.0 m/s; [0-9]+ of its last "
                           "[0-9]+ answers were \\*stale world\\*"));
}

TEST(FlightCause, OfAContactAtRestSaysSinceWhenTheVehicleStood) {
  Story story;
  story.fly(0, 2, 2.0).fly(2, 6, 0.0);
  FlightResult result;
  result.contacts_at_rest = 1;
  const Explanation why = explain(story.evidence, {FlightOutcome::Collision, "touched obstacle 7 at 6.000 s", result});
  EXPECT_THAT(why.sentence, AllOf(HasSubstr("touched obstacle 7 at 6.000 s, at rest since 2.0 s"),
                                  HasSubstr("a prediction or the tracking failed")));
}

TEST(FlightCause, OfAStartInAnObstacleIsToMoveIt) {
  Story story;
  const Explanation why =
      explain(story.evidence, {FlightOutcome::Collision, "the start lies in obstacle 2 at 0.000 s"});
  EXPECT_EQ(why.sentence, "the start lies in obstacle 2 at 0.000 s: move uav.start, or the obstacle");
}

TEST(FlightCause, OfAFlightThatReachedItsGoalAsBelievedIsItsEstimate) {
  Story story;
  story.fly(0, 6, 0.5);
  const std::string detail = "reached as believed: 0.05 m from the goal by its own estimate, 0.52 m in truth";
  const Explanation why = explain(story.evidence, {FlightOutcome::Timeout, detail});
  EXPECT_EQ(why.cause, Cause::EstimateOff);
  EXPECT_THAT(why.sentence, HasSubstr(detail));
}

TEST(FlightCause, OfAnAutopilotBeginsWithTheGoalToFlyTo) {
  Story story;
  Goal goal;
  goal.mode = GoalMode::Hold;
  goal.position = kGoal;
  story.evidence.receive(goal);
  story.fly_with(0, 5, 0.0, PlanReason::AtGoal);
  EXPECT_FALSE(story.evidence.begun());
  goal.mode = GoalMode::Go;
  goal.header.utime = at(5);
  story.evidence.receive(goal);
  story.fly(5, 10, 0.5);
  EXPECT_EQ(story.evidence.begun(), at(5));
}

}  // namespace
}  // namespace tern
