#include "planner/safety/checker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/wire/message_limits.h"
#include "core/world/names.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};
constexpr int kIntervals = 6;
const Box kEverywhere(Vec3::Constant(-1e4), Vec3::Constant(1e4));

/// A valid plan that moves on every axis, and a problem that it just satisfies. Each test breaks one rule.
class CheckPlan : public ::testing::Test {
 protected:
  CheckPlan() {
    start_.p = Vec3(10, -20, 3);
    start_.v = Vec3(1.0, -0.8, 0.4);
    start_.a = Vec3(0.5, 0.7, -0.6);
    plan_.start = kStart;
    plan_.interval = Duration{250'000};
    plan_.control_points.resize(3, kIntervals + 3);
    plan_.control_points.leftCols<3>() = start_control_points(start_, plan_.interval.seconds());
    const Vec3 velocities[] = {Vec3(1.2, -0.7, 0.3), Vec3(0.9, -0.9, 0.5), Vec3(0.6, -0.5, 0.2), Vec3(0.2, -0.2, 0.1)};
    for (int l = 2; l < 6; ++l) {
      plan_.control_points.col(l + 1) = plan_.control_points.col(l) + velocities[l - 2] * plan_.interval.seconds();
    }
    plan_.control_points.col(7) = plan_.control_points.col(8) = plan_.control_points.col(6);
    problem_.start = start_;
    problem_.limits.j_max = Vec3::Constant(100.0);
    problem_.centre_box = kEverywhere;
  }

  CheckReport check(const std::vector<Track>& tracks = {}) const {
    const auto obstacles = obstacles_of(tracks);
    std::vector<double> times;
    for (int k = 0; k <= kIntervals; ++k) times.push_back(k * 0.25);
    const SweptObstacles swept(obstacles, body_, kStart, times, kEverywhere);
    SeparationCache cache(swept);
    return check_plan(plan_, problem_, cache);
  }
  void expect_fault(Breach breach, int axis) const {
    const CheckReport report = check();
    EXPECT_EQ(report.breach, breach) << to_string(report.breach);
    EXPECT_EQ(report.axis, axis);
    EXPECT_TRUE(report.certificate.empty());
  }
  [[nodiscard]] MotionBounds bounds() const { return motion_bounds(plan_.spline()); }
  [[nodiscard]] Box curve_box() const {
    Box box;
    for (int j = 0; j < kIntervals; ++j) box.extend(plan_.spline().position_bounds(j));
    return box;
  }

  MotionSample start_;
  TimedSpline plan_;
  HorizonProblem problem_;
  Body body_;
};

constexpr double kBeyond = 1.0 + 2.0 * kLimitTolerance;  // a limit is exceeded
constexpr double kWithin = 1.0 + 0.5 * kLimitTolerance;

TEST_F(CheckPlan, PassesAGoodPlan) {
  const CheckReport report = check();
  EXPECT_TRUE(report.ok()) << to_string(report.breach) << " axis " << report.axis << " " << report.value;
}

TEST_F(CheckPlan, RefusesShapesThatAreNoPlan) {
  const TimedSpline good = plan_;
  plan_.interval = Duration{0};
  expect_fault(Breach::Shape, -1);
  plan_ = good;
  plan_.interval = Duration{-250'000};
  expect_fault(Breach::Shape, -1);
  plan_ = good;
  plan_.control_points = Points(good.control_points.leftCols(6));
  expect_fault(Breach::Shape, -1);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    plan_ = good;
    plan_.control_points(1, 4) = bad;
    expect_fault(Breach::Shape, -1);
  }
  plan_.control_points = start_.p.replicate(1, kMaxIntervals + 4);
  expect_fault(Breach::Shape, -1);
}

TEST_F(CheckPlan, RefusesNumbersThatOverflow) {
  plan_.control_points.col(5) = Vec3::Constant(1e300);
  EXPECT_FALSE(check().ok());
}

TEST_F(CheckPlan, RefusesAStartElsewhere) {
  for (int axis = 0; axis < 3; ++axis) {
    problem_.start = start_;
    problem_.start.p[axis] += 2.0 * kJoinTolerance;
    expect_fault(Breach::Join, axis);
    problem_.start.p[axis] = start_.p[axis] - 0.5 * kJoinTolerance;
    EXPECT_TRUE(check().ok());
  }
}

TEST_F(CheckPlan, RefusesAStartWithAnotherVelocity) {
  for (int axis = 0; axis < 3; ++axis) {
    problem_.start = start_;
    problem_.start.v[axis] -= 2.0 * kJoinTolerance;
    expect_fault(Breach::Join, axis);
    problem_.start.v[axis] = start_.v[axis] + 0.5 * kJoinTolerance;
    EXPECT_TRUE(check().ok());
  }
}

TEST_F(CheckPlan, RefusesAStartWithAnotherAcceleration) {
  for (int axis = 0; axis < 3; ++axis) {
    problem_.start = start_;
    problem_.start.a[axis] += 2.0 * kJoinTolerance;
    expect_fault(Breach::Join, axis);
    problem_.start.a[axis] = start_.a[axis] - 0.5 * kJoinTolerance;
    EXPECT_TRUE(check().ok());
  }
}

TEST_F(CheckPlan, RefusesAStartThatIsNotANumber) {
  problem_.start.a.y() = std::nan("");
  expect_fault(Breach::Join, 1);
}

TEST_F(CheckPlan, RefusesVelocityBeyondItsLimitOnEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    problem_.limits = Limits{};
    problem_.limits.v_max[axis] = bounds().v_max[axis] / kBeyond;
    expect_fault(Breach::Velocity, axis);
    problem_.limits.v_max[axis] = bounds().v_max[axis] / kWithin;
    EXPECT_TRUE(check().ok());
  }
}

TEST_F(CheckPlan, RefusesAccelerationBeyondItsLimitOnEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    problem_.limits = Limits{};
    problem_.limits.a_max[axis] = bounds().a_max[axis] / kBeyond;
    expect_fault(Breach::Acceleration, axis);
    problem_.limits.a_max[axis] = bounds().a_max[axis] / kWithin;
    EXPECT_TRUE(check().ok());
  }
}

TEST_F(CheckPlan, RefusesJerkBeyondItsLimitOnEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    problem_.limits = Limits{};
    problem_.limits.j_max[axis] = bounds().j_max[axis] / kBeyond;
    expect_fault(Breach::Jerk, axis);
    problem_.limits.j_max[axis] = bounds().j_max[axis] / kWithin;
    EXPECT_TRUE(check().ok());
  }
}

TEST_F(CheckPlan, RefusesAVelocityThatPeaksInsideAnInterval) {
  // At every knot the velocity is within the limit; between them it is not.
  double at_knots = 0.0;
  plan_.control_points = start_.p.replicate(1, kIntervals + 3);
  plan_.control_points(0, 4) += 1.0;
  problem_.start = plan_.spline().sample(0.0);
  problem_.limits.a_max = problem_.limits.j_max = Vec3::Constant(1e6);
  for (int j = 0; j <= kIntervals; ++j) at_knots = std::max(at_knots, std::abs(plan_.spline().sample(0.25 * j).v.x()));
  ASSERT_LT(at_knots, 0.999 * bounds().v_max.x());
  problem_.limits.v_max.x() = 0.5 * (at_knots + bounds().v_max.x());
  expect_fault(Breach::Velocity, 0);
}

TEST_F(CheckPlan, RefusesAnEndThatIsNotAtRest) {
  for (const int point : {6, 7, 8}) {
    const TimedSpline good = plan_;
    plan_.control_points(2, point) += 1e-12;
    expect_fault(Breach::End, -1);
    plan_ = good;
  }
}

TEST_F(CheckPlan, RefusesToLeaveTheSphere) {
  double farthest = 0.0;
  for (int j = 0; j < kIntervals; ++j) {
    farthest = std::max(farthest, (plan_.spline().minvo(j).colwise() - start_.p).colwise().norm().maxCoeff());
  }
  problem_.sphere_radius = farthest / kBeyond;
  expect_fault(Breach::Sphere, -1);
  problem_.sphere_radius = farthest / kWithin;
  EXPECT_TRUE(check().ok());
}

TEST_F(CheckPlan, RefusesABodyOutsideTheFlightBoxThroughEachOfItsSides) {
  for (const BodyKind kind : kBodyKinds) {
    body_ = body_of(kind);
    const Box tight = grown(curve_box(), body_.half_extents());
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        const auto side = [&](Box& box) -> double& { return upper ? box.max()[axis] : box.min()[axis]; };
        const double inwards = upper ? -1.0 : 1.0;
        Box flight_box = kEverywhere;
        side(flight_box) = upper ? tight.max()[axis] : tight.min()[axis];
        problem_.centre_box = grown(flight_box, -body_.half_extents());
        EXPECT_TRUE(check().ok());
        side(flight_box) += inwards * 2.0 * kBoxTolerance;
        ASSERT_TRUE(flight_box.contains(curve_box()));
        problem_.centre_box = grown(flight_box, -body_.half_extents());
        expect_fault(Breach::FlightBox, axis);
      }
    }
  }
}

/// A small obstacle that is at the curve's middle during interval j, and elsewhere at other times.
Track visitor(std::int64_t id, const TimedSpline& plan, int j) {
  Track track = straight_mover(id, plan.spline().sample((j + 0.5) * 0.25).p, Vec3::Zero(), 0.01, kStart, 1.0);
  const CubicPiece there = track.motion.pieces[0];
  CubicPiece elsewhere = there;
  elsewhere.coefficients(0, 3) += 50.0;
  track.motion.pieces.clear();
  track.alpha.clear();
  for (int k = 0; k < kIntervals; ++k) {
    track.motion.pieces.push_back(k == j ? there : elsewhere);
    track.motion.pieces.back().duration = Duration{250'000};
    track.alpha.emplace_back(Vec3::Zero());
  }
  return track;
}

TEST_F(CheckPlan, RefusesEachPairOfObstacleAndInterval) {
  for (int culprit = 0; culprit < 3; ++culprit) {
    for (int j = 0; j < kIntervals; ++j) {
      std::vector<Track> tracks;
      for (int i = 0; i < 3; ++i) {
        const Vec3 harmless = start_.p + Vec3(0, 3.0 + i, 0);
        tracks.push_back(i == culprit ? visitor(i + 1, plan_, j)
                                      : straight_mover(i + 1, harmless, Vec3::Zero(), 0.5, kStart, 2.0));
      }
      const CheckReport report = check(tracks);
      EXPECT_EQ(report.breach, Breach::NotSeparated) << "obstacle " << culprit + 1 << " in interval " << j;
      EXPECT_EQ(report.obstacle, culprit + 1);
      EXPECT_LE(std::abs(report.interval - j), 1);
      EXPECT_TRUE(report.certificate.empty());
    }
  }
}

TEST_F(CheckPlan, RefusesEachPairOfMapBoxAndInterval) {
  for (int j = 0; j < kIntervals; ++j) {
    const Vec3 there = plan_.spline().sample((j + 0.5) * 0.25).p;
    const std::vector<PlanningObstacle> obstacles{
        {-1, nullptr, box_around(there + Vec3(0, 5, 0), Vec3::Constant(0.2)), {}},
        {-2, nullptr, box_around(there, Vec3::Constant(0.001)), {}}};
    const SweptObstacles swept(obstacles, body_, kStart, {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5}, kEverywhere);
    SeparationCache cache(swept);
    const CheckReport report = check_plan(plan_, problem_, cache);
    EXPECT_EQ(report.breach, Breach::NotSeparated);
    EXPECT_EQ(report.obstacle, -2);
  }
}

TEST_F(CheckPlan, RefusesAGrazeByTheBodyThatTheCentreMisses) {
  const Vec3 end = plan_.control_points.col(8);
  for (const BodyKind kind : kBodyKinds) {
    body_ = body_of(kind);
    const double reach = body_.vertices.row(0).maxCoeff() + body_.radius;
    const Box wall(Vec3(end.x(), -100, -100), Vec3(end.x() + 5, 100, 100));
    EXPECT_TRUE(check({standing_box(1, Box(wall.min() + Vec3(reach + 1e-3, 0, 0), wall.max()), kStart)}).ok());
    EXPECT_EQ(check({standing_box(1, Box(wall.min() + Vec3(reach - 1e-5, 0, 0), wall.max()), kStart)}).breach,
              Breach::NotSeparated);
  }
}

TEST_F(CheckPlan, NeverPassesAPlanThatDenseSamplingSeesCollide) {
  int passed = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Rng rng(seed);
    plan_ = random_trajectory(rng, Vec3::Zero(), kStart, Limits{}, kIntervals);
    problem_.start = MotionSample{};
    problem_.sphere_radius = 20.0;
    problem_.limits = Limits{};
    body_ = body_of(kBodyKinds[seed % 3]);
    std::vector<Track> tracks;
    for (int id = 1; id <= 6; ++id) {
      tracks.push_back(
          random_mover(rng, id, Box(Vec3::Constant(-5), Vec3::Constant(5)), kStart - Duration{100'000}, 1.2));
    }
    const auto obstacles = obstacles_of(tracks);
    std::vector<double> times;
    for (int k = 0; k <= kIntervals; ++k) times.push_back(k * plan_.interval.seconds());
    const SweptObstacles swept(obstacles, body_, kStart, times, kEverywhere);
    SeparationCache cache(swept);
    const CheckReport report = check_plan(plan_, problem_, cache);
    ASSERT_TRUE(report.ok() || report.breach == Breach::NotSeparated)
        << to_string(report.breach) << " at seed " << seed;
    if (!report.ok()) continue;
    ++passed;
    ASSERT_GT(least_gap(plan_, body_, obstacles, kStart, plan_.end(), Duration{5'000}), 0.0) << "seed " << seed;
  }
  EXPECT_GT(passed, 100);
}

TEST_F(CheckPlan, GivesAPlaneForEveryPairWhoseBoxesOverlap) {
  const std::vector<Track> tracks{
      straight_mover(5, plan_.spline().sample(0.75).p + Vec3(0.22, 0.1, 0), Vec3::Zero(), 0.05, kStart, 2.0)};
  const auto obstacles = obstacles_of(tracks);
  std::vector<double> times;
  for (int k = 0; k <= kIntervals; ++k) times.push_back(k * 0.25);
  const SweptObstacles swept(obstacles, body_, kStart, times, kEverywhere);
  SeparationCache cache(swept);
  const CheckReport report = check_plan(plan_, problem_, cache);
  ASSERT_TRUE(report.ok());
  for (int j = 0; j < kIntervals; ++j) {
    const Points4 points = plan_.spline().minvo(j);
    const Box box(points.rowwise().minCoeff(), points.rowwise().maxCoeff());
    if (!box.intersects(swept.neighbours(j)[0].box)) continue;
    bool has = false;
    for (const CertificatePlane& plane : report.certificate) has = has || (plane.interval == j && plane.track == 5);
    EXPECT_TRUE(has) << "interval " << j;
  }
  EXPECT_FALSE(report.certificate.empty());
}

TEST_F(CheckPlan, RefusesACertificateThatNoPlanCanCarry) {
  // Crumbs around the curve: each within its box, none on it.
  std::vector<Track> crumbs;
  Rng rng(3);
  while (crumbs.size() < 3000) {
    const Vec3 p = plan_.spline().sample(rng.uniform() * 1.5).p + random_vector(rng, 0.3);
    crumbs.push_back(
        standing_box(static_cast<std::int64_t>(crumbs.size()) + 1, box_around(p, Vec3::Constant(1e-3)), kStart));
    if (!check({crumbs.back()}).ok() || check({crumbs.back()}).certificate.empty()) crumbs.pop_back();
  }
  const CheckReport report = check(crumbs);
  EXPECT_EQ(report.breach, Breach::TooManyPlanes) << to_string(report.breach);
  EXPECT_GT(report.value, kMaxCertificatePlanes);
  EXPECT_TRUE(report.certificate.empty());
  crumbs.resize(300);
  EXPECT_TRUE(check(crumbs).ok());
}

TEST(CheckSeparation, JudgesAMotionUnderWayByItsPiecesAlone) {
  std::vector<PowerCubic> pieces(2, PowerCubic::Zero());
  pieces[0].col(2) = pieces[1].col(3) = Vec3(1, 0, 0);
  pieces[1].col(2) = Vec3(1, 0, 0);
  for (const int j : {0, 1}) {
    const std::vector<Track> tracks{standing_box(3, box_around(Vec3(0.5 + j, 0, 0), Vec3::Constant(0.1)), kStart)};
    const auto obstacles = obstacles_of(tracks);
    const SweptObstacles swept(obstacles, Body{}, kStart, {0.0, 0.3, 0.6}, kEverywhere);
    SeparationCache cache(swept);
    const CheckReport report = check_separation(pieces, cache);
    EXPECT_EQ(report.breach, Breach::NotSeparated);
    EXPECT_EQ(report.interval, j);
    EXPECT_EQ(report.obstacle, 3);
  }
  const std::vector<PlanningObstacle> none;
  const SweptObstacles swept(none, Body{}, kStart, {0.0, 0.3, 0.6}, kEverywhere);
  SeparationCache cache(swept);
  EXPECT_TRUE(check_separation(pieces, cache).ok());
}

}  // namespace
}  // namespace tern
