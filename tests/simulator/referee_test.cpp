#include "simulator/referee/referee.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace tern {
namespace {

using ::testing::HasSubstr;

/// 10 m along x, in a wide box.
Scenario short_flight() {
  Scenario s;
  s.uav.start = Vec3(0, 0, 1);
  s.uav.goal = Vec3(10, 0, 1);
  return s;
}

ObstacleSpec cube(const Vec3& centre, double half) {
  ObstacleSpec o;
  o.name = "cube";
  o.centre = centre;
  o.half_extents = Vec3::Constant(half);
  return o;
}

Referee referee_of(const Scenario& s) { return Referee(s, make_world(s, "").value()); }

MotionSample at_rest_at(const Vec3& p) {
  MotionSample s;
  s.p = p;
  return s;
}

/// Rest to rest along a straight line: top speed 1.5 · distance / duration.
CubicPiece hop(const Vec3& from, const Vec3& to, double duration_s) {
  return hermite_piece(at_rest_at(from), at_rest_at(to), Duration::from_seconds(duration_s));
}

TEST(Referee, NamesWhoPassesTheStartWhileAllWait) {
  Scenario s = short_flight();
  ObstacleSpec passer = cube(Vec3::Zero(), 0.25);
  passer.motion = WaypointMotion{{{-3.0, Vec3(0, -2, 1)}, {1.0, Vec3(0, 2, 1)}}, false, true};  // at the start at -1 s
  ObstacleSpec absent = passer, beside = passer;
  absent.motion = WaypointMotion{{{-0.5, Vec3(0, 0.5, 1)}, {1.0, Vec3(0, 2, 1)}}, false, true};  // begins beyond it
  beside.motion = WaypointMotion{{{-3.0, Vec3(1, -2, 1)}, {1.0, Vec3(1, 2, 1)}}, false, true};
  s.world.obstacles = {beside, passer, absent};
  const Referee referee = referee_of(s);
  EXPECT_THAT(referee.passing_the_start(-1.5), testing::ElementsAre("obstacle 1 'cube'"));
  EXPECT_THAT(referee.passing_the_start(-0.5), testing::IsEmpty());
  EXPECT_THAT(referee.passing_the_start(0.0), testing::IsEmpty());
}

TEST(Referee, JudgesAFlightThatReachesItsGoal) {
  Scenario s = short_flight();
  s.world.obstacles = {cube(Vec3(5, 1, 1), 0.4)};
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const auto verdict = referee.verdict();
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->outcome, FlightOutcome::Reached) << verdict->detail;
  EXPECT_NEAR(verdict->min_clearance_m, 0.5, kClearanceTolerance);
  // v = 12/5·(τ − τ²)·… with τ = t/5: speed 60/25·t·(1 − t/5) falls under 0.1 at t = 2.5 + √(6.25 − 0.208333).
  EXPECT_NEAR(verdict->flight_time_s, 2.5 + std::sqrt(6.25 - 0.5 / 2.4), 1e-3);
  EXPECT_LT(verdict->first_entry_s, verdict->flight_time_s);
  EXPECT_NEAR(verdict->mean_speed_mps, 10.0 / verdict->flight_time_s, 1e-12);
  EXPECT_NEAR(verdict->top_speed_mps, 3.0, 1e-9);
  EXPECT_NEAR(verdict->path_length_m, 10.0, 0.01);
  EXPECT_EQ(verdict->stops, 0);
  EXPECT_EQ(verdict->limit_violations, 0);
}

TEST(Referee, JudgesTheMapsOccupiedVoxelsBesideTheObstacles) {
  Scenario s = short_flight();
  s.world.obstacles = {cube(Vec3(5, 1, 1), 0.4)};
  Referee passes = referee_of(s);
  ASSERT_TRUE(passes.set_map({Box(Vec3(4, -3, 0), Vec3(5, -0.15, 2)), Box(Vec3(20, -3, 0), Vec3(21, 3, 2))}));
  passes.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const FlightResult passed = passes.verdict().value();
  EXPECT_EQ(passed.outcome, FlightOutcome::Reached) << passed.detail;
  EXPECT_NEAR(passed.min_clearance_m, 0.5, kClearanceTolerance);
  EXPECT_NEAR(passed.min_map_clearance_m, 0.05, kClearanceTolerance);

  Referee hits = referee_of(s);
  ASSERT_TRUE(hits.set_map({Box(Vec3(4, -3, 0), Vec3(5, 0.05, 2))}));
  hits.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const FlightResult hit = hits.verdict().value();
  EXPECT_EQ(hit.outcome, FlightOutcome::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("touched the map at"));
  EXPECT_LT(hit.min_map_clearance_m, 0.0);
  EXPECT_GT(hit.min_clearance_m, 0.0);
  EXPECT_FALSE(hits.set_map({Box(Vec3(2e5, 0, 0), Vec3(3e5, 1, 1))})) << "farther than a world reaches";
}

TEST(Referee, EndsTheFlightAtTheFirstContact) {
  Scenario s = short_flight();
  s.world.obstacles = {cube(Vec3(8, 0, 1), 0.4), cube(Vec3(5, 0, 1), 0.4)};
  Referee referee = referee_of(s);
  const CubicPiece flight = hop(s.uav.start, s.uav.goal, 5.0);
  referee.advance({}, flight);
  const FlightResult result = referee.verdict().value();
  EXPECT_EQ(result.outcome, FlightOutcome::Collision);
  EXPECT_THAT(result.detail, HasSubstr("touched obstacle 1 'cube'"));
  EXPECT_LT(result.min_clearance_m, 0.0);
  EXPECT_NEAR(sample_cubic(flight.coefficients, result.flight_time_s).p.x(), 4.5, 1e-4);
  EXPECT_NEAR(result.path_length_m, 4.5, 1e-3);
  EXPECT_TRUE(std::isnan(result.first_entry_s));
  EXPECT_TRUE(std::isnan(result.mean_speed_mps));
}

TEST(Referee, EndsAFlightThatStartsInAMoverAtOnceAndSaysSo) {
  Scenario s = short_flight();
  s.world.obstacles = {cube(Vec3(5, 2, 1), 0.4), cube(Vec3(0.2, 0, 1), 0.4)};
  s.world.obstacles[1].motion = LinearMotion{Vec3(0, 1, 0)};
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const FlightResult result = referee.verdict().value();
  EXPECT_EQ(result.outcome, FlightOutcome::Collision);
  EXPECT_THAT(result.detail, HasSubstr("the start lies in obstacle 1 'cube' at 0.000 s"));
  EXPECT_EQ(result.flight_time_s, 0.0);
  EXPECT_LT(result.min_clearance_m, 0.0);
}

TEST(Referee, CountsAFlightThatLeftItsLimitsAsFailed) {
  Scenario s = short_flight();
  s.uav.limits.v_max = Vec3(2.9, 6, 6);
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const FlightResult result = referee.verdict().value();
  EXPECT_EQ(result.outcome, FlightOutcome::Failed);
  EXPECT_EQ(result.limit_violations, 1);
  EXPECT_THAT(result.detail, HasSubstr("speed along x"));
}

TEST(Referee, CountsAFlightThatLeftItsFlightBoxAsFailed) {
  Scenario s = short_flight();
  s.uav.flight_box = Box(Vec3(-1, -0.09, 0), Vec3(11, 1, 2));
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Failed);
  EXPECT_THAT(referee.verdict()->detail, HasSubstr("outside the flight box"));
}

TEST(Referee, CountsATeleportAsAViolation) {
  Scenario s = short_flight();
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, Vec3(4, 0, 1), 2.0));
  referee.advance(Duration{2'000'000}, hop(Vec3(4.1, 0, 1), s.uav.goal, 3.0));
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Failed);
  EXPECT_THAT(referee.verdict()->detail, HasSubstr("position jumps at 2.0"));
}

TEST(Referee, CallsTimeAtThreeBoundsAndTenSeconds) {
  Scenario s = short_flight();
  Referee referee = referee_of(s);
  EXPECT_DOUBLE_EQ(referee.timeout_s(), 3.0 * rest_to_rest_bound_s(s.uav.start, s.uav.goal, s.uav.limits) + 10.0);
  referee.advance({}, hop(s.uav.start, Vec3(9.5, 0, 1), 100.0));
  const FlightResult result = referee.verdict().value();
  EXPECT_EQ(result.outcome, FlightOutcome::Timeout);
  EXPECT_DOUBLE_EQ(result.flight_time_s, referee.timeout_s());
  s.timeout_s = 1.234;
  Referee impatient = referee_of(s);
  impatient.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  EXPECT_DOUBLE_EQ(impatient.verdict()->flight_time_s, 1.234);
}

TEST(Referee, CountsAStopOnTheWayButNotTheArrival) {
  Scenario s = short_flight();
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, Vec3(4, 0, 1), 3.0));
  referee.advance(Duration{3'000'000}, hop(Vec3(4, 0, 1), s.uav.goal, 4.0));
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Reached);
  EXPECT_EQ(referee.verdict()->stops, 1);
}

TEST(Referee, GivesTheSameVerdictHoweverThePieceIsCut) {
  Scenario s = short_flight();
  s.world.generator = "mader_corridor";
  s.world.count = 20;
  s.world.obstacles = {cube(Vec3(5, 0.6, 1), 0.4)};
  const CubicPiece whole = hop(s.uav.start, Vec3(10, 0, 1), 5.0);
  Referee once = referee_of(s);
  once.advance({}, whole);
  Referee cut = referee_of(s);
  for (int k = 0; k < 500; ++k) {
    const double from = 0.01 * k;
    CubicPiece part;
    part.duration = Duration{10'000};
    const PowerCubic unit = reparametrized(whole.coefficients, from, from + 0.01);
    part.coefficients << unit.col(0) * 1e6, unit.col(1) * 1e4, unit.col(2) * 1e2, unit.col(3);
    if (!cut.verdict()) cut.advance(Duration{10'000 * k}, part);
  }
  const FlightResult a = once.result_so_far();
  const FlightResult b = cut.result_so_far();
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_NEAR(a.flight_time_s, b.flight_time_s, 2e-5);
  EXPECT_NEAR(a.min_clearance_m, b.min_clearance_m, kClearanceTolerance);
  EXPECT_NEAR(a.path_length_m, b.path_length_m, 1e-6);
  EXPECT_NEAR(a.jerk_integral, b.jerk_integral, 1e-4 * a.jerk_integral);
  EXPECT_EQ(a.limit_violations, b.limit_violations);
}

TEST(Referee, SaysWhatIsKnownBeforeTheEnd) {
  const Scenario s = short_flight();
  Referee referee = referee_of(s);
  EXPECT_FALSE(referee.verdict());
  referee.advance({}, hop(s.uav.start, Vec3(5, 0, 1), 2.0));
  EXPECT_FALSE(referee.verdict());
  const FlightResult so_far = referee.result_so_far();
  EXPECT_EQ(so_far.outcome, FlightOutcome::Failed);
  EXPECT_EQ(so_far.detail, "the flight has not ended");
  EXPECT_EQ(so_far.flight_time_s, 2.0);
  EXPECT_TRUE(std::isnan(so_far.min_clearance_m)) << "there is no obstacle";
}

TEST(Referee, LetsAVehicleGuardItsPlaceUntilItsEarliestArrival) {
  Scenario s = short_flight();
  s.uav.goal = s.uav.start;
  Referee referee = referee_of(s);
  referee.set_earliest_arrival(1.5);
  referee.advance({}, hop(s.uav.start, s.uav.start, 5.0));
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Reached);
  EXPECT_NEAR(referee.verdict()->flight_time_s, 1.5, 2 * kMeasureTimeResolution);
}

TEST(Referee, JudgesByTheGoalInForce) {
  Scenario s = short_flight();
  s.timeout_s = 30.0;
  Referee referee = referee_of(s);
  referee.set_goal(std::nullopt);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  EXPECT_FALSE(referee.verdict()) << "no goal, no arrival";
  referee.set_goal(Vec3(10, 4, 1));
  referee.advance(Duration{5'000'000}, hop(s.uav.goal, Vec3(10, 4, 1), 3.0));
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Reached);
}

TEST(Referee, StatesNoMeanSpeedIfTheGoalChangedInFlight) {
  Scenario s = short_flight();
  s.timeout_s = 30.0;
  const Vec3 turn(5, 0, 1);
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, turn, 3.0));
  referee.set_goal(s.uav.start);
  referee.advance(Duration{3'000'000}, hop(turn, s.uav.start, 3.0));
  ASSERT_TRUE(referee.verdict());
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Reached) << referee.verdict()->detail;
  EXPECT_TRUE(std::isnan(referee.verdict()->mean_speed_mps));
}

TEST(Referee, TakesNothingAfterTheVerdict) {
  const Scenario s = short_flight();
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const double length = referee.verdict()->path_length_m;
  referee.advance(referee.now(), hop(s.uav.goal, s.uav.start, 5.0));
  EXPECT_EQ(referee.verdict()->path_length_m, length);
}

TEST(Referee, ThrowsOnPiecesThatDoNotFollowOneAnother) {
  const Scenario s = short_flight();
  Referee referee = referee_of(s);
  const CubicPiece piece = hop(s.uav.start, s.uav.goal, 5.0);
  EXPECT_THROW(referee.advance(Duration{1}, piece), std::invalid_argument);
  CubicPiece empty = piece;
  empty.duration = {};
  EXPECT_THROW(referee.advance({}, empty), std::invalid_argument);
  CubicPiece nan = piece;
  nan.coefficients(0, 0) = std::nan("");
  EXPECT_THROW(referee.advance({}, nan), std::invalid_argument);
}

TEST(Referee, MeasuresExposureUntilTheEnd) {
  Scenario s = short_flight();
  s.semantics.regions = {Region{"meadow", "texture", Box(Vec3(4, -1, 0), Vec3(6, 1, 2))}};
  Referee referee = referee_of(s);
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  const Exposure meadow = referee.verdict()->exposure.at(0);
  EXPECT_EQ(meadow.region, "meadow");
  EXPECT_NEAR(meadow.metres, 2.0, 2e-3);
  EXPECT_NEAR(meadow.near_metres, 4.0, 2e-3);
}

TEST(Referee, TellsAContactInFlightFromOneAtRest) {
  Scenario s = short_flight();
  s.world.obstacles = {cube(Vec3(5, 0, 1), 0.4)};
  Referee flies_into = referee_of(s);
  flies_into.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  EXPECT_EQ(flies_into.verdict()->contacts_moving, 1);
  EXPECT_EQ(flies_into.verdict()->contacts_at_rest, 0);
  s.world.obstacles[0].motion = LinearMotion{Vec3(-2, 0, 0), 0.0};
  Referee is_hit = referee_of(s);
  is_hit.advance({}, hop(s.uav.start, s.uav.start, 5.0));
  ASSERT_TRUE(is_hit.verdict());
  EXPECT_EQ(is_hit.verdict()->contacts_moving, 0);
  EXPECT_EQ(is_hit.verdict()->contacts_at_rest, 1);
  EXPECT_EQ(is_hit.verdict()->obstacles, 1);
}

TEST(Referee, CountsWhoWasThereAndWhoWasLeftOut) {
  Scenario s = short_flight();
  ObstacleSpec beside = cube(Vec3::Zero(), 0.4);
  beside.motion = WaypointMotion{{{1.0, Vec3(0, 1, 1)}, {9.0, Vec3(0, 1, 1)}}, false, true, 3.0};
  ObstacleSpec later = beside;
  later.name = "later";
  std::get<WaypointMotion>(later.motion).points = {{100.0, Vec3(9, 9, 1)}, {200.0, Vec3(9, 9, 1)}};
  s.world.obstacles = {cube(Vec3(5, 4, 1), 0.4), beside, later};
  Referee referee = referee_of(s);
  referee.admit(5.0, [](double) { return Vec3(0, 0, 1); });
  referee.advance({}, hop(s.uav.start, s.uav.goal, 5.0));
  EXPECT_EQ(referee.verdict()->outcome, FlightOutcome::Reached) << referee.verdict()->detail;
  EXPECT_EQ(referee.verdict()->obstacles, 1);
  EXPECT_EQ(referee.verdict()->obstacles_left_out, 1);
}

}  // namespace
}  // namespace tern
