#include "simulator/referee/flight_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace tern {
namespace {

using ::testing::HasSubstr;

const Box kBody = box_around(Vec3::Zero(), Vec3::Constant(0.1));

FlownPiece piece_of(const Vec3& p, const Vec3& v, const Vec3& half_a = Vec3::Zero(),
                    const Vec3& sixth_j = Vec3::Zero()) {
  FlownPiece piece;
  piece.coefficients << sixth_j, half_a, v, p;
  return piece;
}

UavSpec uav() {
  UavSpec u;
  u.limits.v_max = Vec3(6, 5, 4);
  u.limits.a_max = Vec3(20, 15, 10);
  u.limits.j_max = Vec3(60, 60, 60);
  u.flight_box = Box(Vec3(-10, -3, 0), Vec3(90, 3, 4));
  return u;
}

std::string first_violation(const FlownPiece& piece, double duration) {
  LimitWatch watch(uav(), kBody);
  watch.advance(piece, 0.0, duration);
  EXPECT_LE(watch.violations(), 1);
  return watch.first();
}

TEST(LimitWatch, AllowsLimitsToTheirTolerance) {
  const Vec3 p(0, 0, 2);
  EXPECT_EQ(first_violation(piece_of(p, Vec3(6 * (1 + 0.9e-6), 0, 0)), 0.01), "");
  EXPECT_THAT(first_violation(piece_of(p, Vec3(6 * (1 + 1.1e-6), 0, 0)), 0.01), HasSubstr("speed along x"));
  EXPECT_EQ(first_violation(piece_of(p, Vec3::Zero(), Vec3(0, -7.5, 0)), 0.01), "");
  EXPECT_THAT(first_violation(piece_of(p, Vec3::Zero(), Vec3(0, -7.50001, 0)), 0.01),
              HasSubstr("acceleration along y"));
  EXPECT_EQ(first_violation(piece_of(p, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -10)), 0.01), "");
  EXPECT_THAT(first_violation(piece_of(p, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -10.0001)), 0.01),
              HasSubstr("jerk along z"));
}

TEST(LimitWatch, FindsTheExtremumInsideAPiece) {
  // v_z = v + 0.4 t − 29.7 t²: v + 0.00135 at t = 0.0067, v + 0.00103 at the end.
  EXPECT_EQ(first_violation(piece_of(Vec3(0, 0, 2), Vec3(0, 0, 3.9985), Vec3(0, 0, 0.2), Vec3(0, 0, -9.9)), 0.01), "");
  EXPECT_THAT(first_violation(piece_of(Vec3(0, 0, 2), Vec3(0, 0, 3.9988), Vec3(0, 0, 0.2), Vec3(0, 0, -9.9)), 0.01),
              HasSubstr("speed along z 4.00"));
}

TEST(LimitWatch, HoldsTheWholeBodyInsideTheFlightBox) {
  EXPECT_EQ(first_violation(piece_of(Vec3(0, 2.9, 2), Vec3::Zero()), 0.01), "");
  EXPECT_THAT(first_violation(piece_of(Vec3(0, 2.90001, 2), Vec3::Zero()), 0.01), HasSubstr("outside the flight box"));
  EXPECT_THAT(first_violation(piece_of(Vec3(0, 0, 0.0999), Vec3::Zero()), 0.01), HasSubstr("outside the flight box"));
}

TEST(LimitWatch, CountsAViolationThatLastsOnce) {
  LimitWatch watch(uav(), kBody);
  const FlownPiece fast = piece_of(Vec3(0, 0, 2), Vec3(7, 0, 0));
  const FlownPiece slow = piece_of(Vec3(0, 0, 2), Vec3(1, 0, 0));
  watch.advance(fast, 0.00, 0.01);
  watch.advance(fast, 0.01, 0.02);
  watch.advance(slow, 0.02, 0.03);
  watch.advance(fast, 0.03, 0.04);
  EXPECT_EQ(watch.violations(), 2);
}

TEST(LimitWatch, CountsJumps) {
  LimitWatch watch(uav(), kBody);
  MotionSample a;
  MotionSample b;
  b.p.x() = 0.9e-6;
  b.v.y() = 0.9e-6;
  watch.join(a, b, 1.0);
  EXPECT_EQ(watch.violations(), 0);
  b.v.y() = 1e-3;
  watch.join(a, b, 1.0);
  EXPECT_THAT(watch.first(), HasSubstr("velocity jumps at 1.0"));
  MotionSample c;
  c.a.z() = 1.0;
  watch.join(a, c, 2.0);
  EXPECT_EQ(watch.violations(), 2) << "jerk is limited, so acceleration may not jump";
  UavSpec free = uav();
  free.limits.j_max = Vec3::Constant(std::numeric_limits<double>::infinity());
  LimitWatch lenient(free, kBody);
  lenient.join(a, c, 2.0);
  EXPECT_EQ(lenient.violations(), 0);
}

TEST(FirstEntry, FindsAPassThroughTheGoalsEdgeBetweenSamples) {
  const Vec3 goal(0.03, 0.1999, 0);
  const auto entry = first_entry(piece_of(Vec3::Zero(), Vec3(6, 0, 0)), 0.0, 0.01, goal);
  ASSERT_TRUE(entry);
  EXPECT_NEAR(*entry, (0.03 - std::sqrt(0.04 - 0.1999 * 0.1999)) / 6.0, 1e-4);
  EXPECT_FALSE(first_entry(piece_of(Vec3::Zero(), Vec3(6, 0, 0)), 0.0, 0.01, Vec3(0.03, 0.2001, 0)));
  EXPECT_FALSE(first_arrival(piece_of(Vec3::Zero(), Vec3(6, 0, 0)), 0.0, 0.01, goal)) << "too fast";
}

TEST(FirstArrival, IsWhenTheVehicleIsSlowAtTheGoal) {
  // v = 1 − 2t, under 0.1 m/s from 0.45 s on; x(0.45) = 0.2475.
  const FlownPiece braking = piece_of(Vec3::Zero(), Vec3(1, 0, 0), Vec3(-1, 0, 0));
  const auto arrival = first_arrival(braking, 0.0, 0.5, Vec3(0.3, 0, 0));
  ASSERT_TRUE(arrival);
  EXPECT_NEAR(*arrival, 0.45, 2 * kMeasureTimeResolution);
  EXPECT_FALSE(first_arrival(braking, 0.0, 0.5, Vec3(0.46, 0, 0)));
}

void fly(FlightMeasures& m, const FlownPiece& piece, double from, double to) {
  const int steps = static_cast<int>(std::lround((to - from) * 100));
  for (int k = 0; k < steps; ++k) m.advance(piece, from + 0.01 * k, from + 0.01 * (k + 1), false);
}

TEST(FlightMeasures, IntegrateLengthSpeedAndJerk) {
  FlightMeasures m({});
  fly(m, piece_of(Vec3::Zero(), Vec3(3, 4, 0)), 0.0, 2.0);
  EXPECT_NEAR(m.path_length_m(), 10.0, 1e-12);
  EXPECT_NEAR(m.top_speed_mps(), 5.0, 1e-12);
  EXPECT_EQ(m.jerk_integral(), 0.0);
  FlightMeasures jerky({});
  fly(jerky, piece_of(Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3(1, 0, 0)), 0.0, 2.0);
  EXPECT_NEAR(jerky.jerk_integral(), 72.0, 1e-9);
  EXPECT_NEAR(jerky.path_length_m(), 8.0, 1e-9);
  EXPECT_NEAR(jerky.top_speed_mps(), 12.0, 1e-9);
}

TEST(FlightMeasures, CountStopsAfterTheFirstSecondHoweverShort) {
  // v = 1.5 − t: stands still for an instant at 1.5 s.
  FlightMeasures m({});
  fly(m, piece_of(Vec3::Zero(), Vec3(1.503, 0, 0), Vec3(-0.5, 0, 0)), 0.0, 3.0);
  EXPECT_EQ(m.stops(), 1);
  FlightMeasures brief({});  // 1 ms under 0.1 m/s between two samples
  fly(brief, piece_of(Vec3::Zero(), Vec3(400 * 1.505, 0, 0), Vec3(-200, 0, 0)), 0.0, 3.0);
  EXPECT_EQ(brief.stops(), 1);
  FlightMeasures early({});
  fly(early, piece_of(Vec3::Zero(), Vec3(0.5, 0, 0), Vec3(-0.5, 0, 0)), 0.0, 0.99);
  EXPECT_EQ(early.stops(), 0);
  FlightMeasures parked({});
  fly(parked, piece_of(Vec3::Zero(), Vec3::Zero()), 0.0, 3.0);
  EXPECT_EQ(parked.stops(), 1);
  FlightMeasures flying({});
  fly(flying, piece_of(Vec3::Zero(), Vec3(0.11, 0, 0)), 0.0, 3.0);
  EXPECT_EQ(flying.stops(), 0);
}

TEST(FlightMeasures, MeasureExposureInsideAndNearEachRegion) {
  const Region box{"lake", "water", Box(Vec3(2, -1, -1), Vec3(5, 1, 1))};
  const Region ball{"far", "water", BallRegion{Vec3(0, 100, 0), 1.0}};
  FlightMeasures m({box, ball});
  fly(m, piece_of(Vec3::Zero(), Vec3(2, 0, 0)), 0.0, 5.0);
  ASSERT_EQ(m.exposure().size(), 2u);
  const Exposure& lake = m.exposure()[0];
  EXPECT_EQ(lake.region, "lake");
  EXPECT_NEAR(lake.seconds, 1.5, 1e-4);
  EXPECT_NEAR(lake.metres, 3.0, 2e-4);
  EXPECT_NEAR(lake.near_seconds, 2.5, 1e-4);
  EXPECT_NEAR(lake.near_metres, 5.0, 2e-4);
  EXPECT_EQ(m.exposure()[1].near_seconds, 0.0);
}

}  // namespace
}  // namespace tern
