#include "planner/heading/heading_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/world/thrust.h"
#include "planner/heading/path_term.h"
#include "planner/heading/track_term.h"
#include "planner/problem/tuning.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kZero{1'700'000'000'000'000};

/// From (0, 0, 1) at 4 m/s along x, then a bend to the left.
TimedSpline bend_to_the_left() {
  TimedSpline t;
  t.start = kZero;
  t.interval = Duration{300'000};
  t.control_points.resize(3, 9);
  t.control_points.row(0) << 0.0, 0.4, 1.2, 2.4, 3.2, 3.4, 3.4, 3.4, 3.4;
  t.control_points.row(1) << 0.0, 0.0, 0.0, 0.0, 0.3, 1.5, 2.5, 2.5, 2.5;
  t.control_points.row(2).setConstant(1.0);
  return t;
}

struct Planned {
  HorizonRequest request;
  Plan plan;
};

Planned planned(const TimedSpline& trajectory, PlanOutcome outcome = PlanOutcome::Optimized) {
  Planned p{request_at(kZero, trajectory), {}};
  p.plan.request_id = p.request.id;
  p.plan.outcome = outcome;
  p.plan.trajectory = trajectory;
  p.plan.local_goal = trajectory.control_points.rightCols<1>() + Vec3(0, 2, 0);
  return p;
}

Track estimated(std::int64_t id, const Vec3& p, double alpha) {
  Track track = straight_mover(id, p, Vec3::Zero(), 0.3, kZero - Duration{100'000}, 3.0);
  track.kind = TrackKind::Estimated;
  track.alpha = {Vec3::Constant(alpha)};
  return track;
}

std::optional<PlanHeading> heading_of(const Planned& p, const std::vector<Track>& tracks, double yaw,
                                      const HeadingLimits& limits = {}) {
  return plan_heading(p.request, p.plan, tracks, limits, heading_start({yaw, 0.0}, p.plan.trajectory.interval));
}

TEST(StopTime, IsThatOfOneAxisByHand) {
  Limits limits;
  limits.a_max = Vec3(20, 30, 1);
  limits.j_max = Vec3(100, 200, 1);
  EXPECT_NEAR(stop_time(5.0, limits), 5.0 / 20.0 + 20.0 / 100.0, 1e-12);
  EXPECT_NEAR(stop_time(1.0, limits), 2.0 * std::sqrt(1.0 / 100.0), 1e-12);
}

TEST(PlanHeading, BelongsToThePlansRequestAndLiesOnItsKnots) {
  const Planned p = planned(bend_to_the_left());
  const auto heading = heading_of(p, {}, 0.0);
  ASSERT_TRUE(heading);
  EXPECT_EQ(heading->request_id, p.plan.request_id);
  EXPECT_EQ(heading->request, p.request.header.name);
  EXPECT_EQ(heading->start, p.request.t_s);
  EXPECT_EQ(heading->interval, p.plan.trajectory.interval);
  EXPECT_EQ(static_cast<long>(heading->control_points.size()), p.plan.trajectory.control_points.cols());
  EXPECT_NEAR(heading->rate_max, to_radians(120.0), 1e-12);
  EXPECT_TRUE(heading_breach(*heading, HeadingLimits{}, YawSample{}).ok());
}

TEST(PlanHeading, TurnsIntoABendBeforeTheFlightDoes) {
  const Planned p = planned(bend_to_the_left());
  const HeadingSpline heading(*heading_of(p, {}, 0.0));
  for (const double after_s : {0.5, 0.8, 1.0}) {
    const UTime t = kZero + Duration::from_seconds(after_s);
    const MotionSample m = p.plan.trajectory.sample(t);
    EXPECT_GT(heading.sample(t).yaw, std::atan2(m.v.y(), m.v.x()) + 0.05) << after_s;
  }
  EXPECT_NEAR(heading.sample(heading.end()).yaw, std::numbers::pi / 2, 0.4) << "towards the local goal";
}

TEST(PlanHeading, OfASlowVehicleLooksAtAnUncertainTrackBesideTheWayAndNotAtADeclaredOne) {
  TimedSpline straight = bend_to_the_left();
  straight.control_points.row(1).setZero();
  straight.control_points.row(0) *= 0.1;
  Planned p = planned(straight);
  p.plan.local_goal = Vec3(6, 0, 1);
  Track track = estimated(1, Vec3(1.5, -1.5, 1.0), 1.2);
  const UTime t = kZero + Duration{500'000};
  EXPECT_NEAR(HeadingSpline(*heading_of(p, {}, 0.0)).sample(t).yaw, 0.0, 1e-9);
  const auto with = heading_of(p, {track}, 0.0);
  EXPECT_LT(HeadingSpline(*with).sample(t).yaw, -0.02) << "it lies to the right";
  EXPECT_GT(with->track_term, 0.0);
  track.kind = TrackKind::Declared;
  EXPECT_NEAR(HeadingSpline(*heading_of(p, {track}, 0.0)).sample(t).yaw, 0.0, 1e-9);
}

TEST(PlanHeading, OfAFastVehicleKeepsToItsWayHoweverManyTracksAreUncertain) {
  TimedSpline straight = bend_to_the_left();
  straight.control_points.row(1).setZero();
  Planned p = planned(straight);
  p.plan.local_goal = Vec3(6, 0, 1);
  std::vector<Track> tracks;
  for (int k = 0; k < 20; ++k) tracks.push_back(estimated(k, Vec3(0.3 * k, -2.0, 1.0), 1.5));
  const HeadingSpline heading(*heading_of(p, tracks, 0.0));
  for (int k = 1; k <= 20; ++k) {
    const UTime t = kZero + Duration{50'000} * k;
    if (p.plan.trajectory.sample(t).v.norm() < 1.0) continue;
    EXPECT_LT(std::abs(heading.sample(t).yaw), 0.5 * 85.2 / 2 / 57.3) << "the way stays in the inner half of the view";
  }
}

TEST(TrackTerm, CountsATrackNearThePlanMoreThanOneFarAwayAndMoreAlphaMore) {
  const Planned p = planned(bend_to_the_left());
  const auto worth = [&](const Track& track) {
    std::vector<LookTarget> targets;
    const std::vector<Track> tracks{track};
    TrackTerm(tracks, p.plan.trajectory, kZero).look({kZero, Vec3(0, 0, 1), Vec3::Zero()}, targets);
    return targets.at(0).worth;
  };
  EXPECT_GT(worth(estimated(1, Vec3(2, 1, 1), 0.5)), 2.0 * worth(estimated(1, Vec3(2, 5, 1), 0.5)));
  EXPECT_GT(worth(estimated(1, Vec3(2, 1, 1), 0.8)), worth(estimated(1, Vec3(2, 1, 1), 0.2)));
}

TEST(TrackTerm, KeepsTheTracksOfMostWorth) {
  const Planned p = planned(bend_to_the_left());
  std::vector<Track> tracks;
  for (int k = 0; k < 30; ++k) tracks.push_back(estimated(k, Vec3(2, k - 10.0, 1), 0.5));
  std::vector<LookTarget> targets;
  TrackTerm(tracks, p.plan.trajectory, kZero).look({kZero, Vec3(0, 0, 1), Vec3::Zero()}, targets);
  EXPECT_EQ(targets.size(), kTracksSeen);
}

TEST(PlanHeading, AfterKeepCommittedLooksAlongWhatIsLeftOfTheCommittedTrajectory) {
  Planned p = planned(bend_to_the_left(), PlanOutcome::KeepCommitted);
  p.request = request_at(kZero + Duration{900'000}, p.plan.trajectory);
  const auto heading = heading_of(p, {}, 0.3);
  ASSERT_TRUE(heading);
  EXPECT_EQ(heading->start, p.request.t_s);
  EXPECT_GT(heading->control_points.back(), 1.2);
}

TEST(PlanHeading, IsNoneForNoPlan) {
  const Planned p = planned(bend_to_the_left(), PlanOutcome::NoPlan);
  EXPECT_FALSE(heading_of(p, {}, 0.0));
}

TEST(FlightDirection, IsThatOfTheVelocityOrOfTheWayAheadOrNone) {
  Planned p = planned(bend_to_the_left());
  p.request.start.v = Vec3(-1, 1, 3);
  EXPECT_NEAR(flight_direction(p.request, p.plan)->yaw, 0.75 * std::numbers::pi, 1e-12);
  p.request.start.v = Vec3(0.1, 0.1, 3);
  EXPECT_NEAR(flight_direction(p.request, p.plan)->yaw, 0.0, 0.1);
  p.plan.trajectory = resting_at(p.request.start.p, kZero);
  p.plan.local_goal = p.request.start.p + Vec3(0, -2, 0);
  EXPECT_NEAR(flight_direction(p.request, p.plan)->yaw, -0.5 * std::numbers::pi, 1e-12);
  p.plan.local_goal = p.request.start.p + Vec3(0, 0, 2);
  EXPECT_FALSE(flight_direction(p.request, p.plan));
}

}  // namespace
}  // namespace tern
