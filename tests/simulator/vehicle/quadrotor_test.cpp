#include "simulator/vehicle/quadrotor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace tern {
namespace {

constexpr double kNoGround = -std::numeric_limits<double>::infinity();
constexpr double kDt = 1e-3;

QuadrotorSpec without_drag() {
  QuadrotorSpec spec;
  spec.drag_per_s = spec.drag_up_per_s = spec.drag_per_m = 0.0;
  return spec;
}

double energy(const QuadrotorSpec& spec, const QuadrotorState& s) {
  return spec.mass_kg * (0.5 * s.v.squaredNorm() + kGravity * s.p.z()) + 0.5 * s.w.dot(spec.inertia.cwiseProduct(s.w));
}

/// Falls and tumbles without thrust.
QuadrotorState tumbling() {
  QuadrotorState s;
  s.v = Vec3(3.0, -2.0, 4.0);
  s.w = Vec3(4.0, -1.0, 2.0);
  return s;
}

QuadrotorState after(const QuadrotorSpec& spec, QuadrotorState s, const Rotors& command, double seconds,
                     double dt = kDt, const Vec3& wind = Vec3::Zero()) {
  for (int k = 0; k < static_cast<int>(std::lround(seconds / dt)); ++k) s = step(spec, s, command, wind, kNoGround, dt);
  return s;
}

RC_GTEST_PROP(Quadrotor, TheSmallestRotationTurnsOneDirectionIntoTheOther, ()) {
  const auto vector = [] {
    return Vec3(*rc::gen::inRange(-100, 101), *rc::gen::inRange(-100, 101), *rc::gen::inRange(-100, 101));
  };
  const Vec3 from = vector(), to = vector();
  RC_PRE(from.norm() > 0.0 && to.norm() > 0.0);
  const Eigen::Quaterniond q = smallest_rotation(from, to);
  RC_ASSERT(std::abs(q.norm() - 1.0) < 1e-12);
  RC_ASSERT((q * from.normalized() - to.normalized()).norm() < 1e-6);
  RC_ASSERT(std::abs(q.vec().dot(from.normalized())) < 1e-12);
}

TEST(Quadrotor, TheSmallestRotationBetweenOppositeDirectionsIsHalfATurn) {
  const Vec3 from(0.3, -2.0, 0.5);
  const Eigen::Quaterniond q = smallest_rotation(from, -from);
  EXPECT_NEAR(q.w(), 0.0, 1e-12);
  EXPECT_NEAR((q * from + from).norm(), 0.0, 1e-12);
}

TEST(Quadrotor, HoversWhereItIs) {
  for (const auto kind : {QuadrotorClass::Camera, QuadrotorClass::Racer}) {
    const QuadrotorSpec spec = quadrotor_spec(kind);
    const QuadrotorState begin = hovering(spec, Vec3(1, 2, 3), 0.7);
    const QuadrotorState end = after(spec, begin, begin.thrust, 10.0);
    EXPECT_LT((end.p - begin.p).norm(), 1e-9);
    EXPECT_LT(end.v.norm(), 1e-9);
  }
}

TEST(Quadrotor, FallsFreelyAsGalileiSays) {
  const QuadrotorSpec spec = without_drag();
  QuadrotorState begin;
  begin.v = Vec3(3.0, 0.0, 1.0);
  const QuadrotorState end = after(spec, begin, {}, 2.0);
  EXPECT_NEAR(end.p.z(), 2.0 - 0.5 * kGravity * 4.0, 1e-9);
  EXPECT_NEAR(end.p.x(), 6.0, 1e-9);
}

TEST(Quadrotor, FallsAtTheSpeedAtWhichDragIsWeight) {
  const QuadrotorSpec spec;
  const double a = spec.drag_per_m, b = spec.drag_up_per_s;
  const double terminal = (-b + std::sqrt(b * b + 4.0 * a * kGravity)) / (2.0 * a);
  EXPECT_NEAR(after(spec, {}, {}, 60.0).v.z(), -terminal, 1e-6 * terminal);
}

TEST(Quadrotor, DriftsWithTheWindWhenNothingElsePushes) {
  QuadrotorState state = hovering(QuadrotorSpec{}, Vec3::Zero(), 0.0);
  const Vec3 wind(8.0, -3.0, 0.0);
  state = after(QuadrotorSpec{}, state, state.thrust, 60.0, kDt, wind);
  EXPECT_LT((state.v - wind).norm(), 1e-6);
}

TEST(Quadrotor, RotorsFollowTheirCommandsAsAFirstOrderLag) {
  const QuadrotorSpec spec;
  const QuadrotorState end = after(spec, hovering(spec, Vec3::Zero(), 0.0), {6.0, 6.0, 6.0, 6.0}, 0.05);
  const double hover = spec.mass_kg * kGravity / 4.0;
  EXPECT_NEAR(end.thrust[2], 6.0 + (hover - 6.0) * std::exp(-0.05 / spec.motor_lag_s), 1e-6);
}

TEST(Quadrotor, KeepsEnergyAndAngularMomentumWithoutDragAndThrust) {
  const QuadrotorSpec spec = without_drag();
  const QuadrotorState begin = tumbling(), end = after(spec, begin, {}, 5.0);
  EXPECT_NEAR(energy(spec, end), energy(spec, begin), 1e-6 * std::abs(energy(spec, begin)));
  const auto momentum = [&](const QuadrotorState& s) { return Vec3(s.q * spec.inertia.cwiseProduct(s.w)); };
  EXPECT_LT((momentum(end) - momentum(begin)).norm(), 1e-6 * momentum(begin).norm());
}

TEST(Quadrotor, LosesEnergyToStillAir) {
  QuadrotorState state = tumbling();
  const QuadrotorSpec spec;
  for (int k = 0; k < 2000; ++k) {
    const QuadrotorState next = step(spec, state, {}, Vec3::Zero(), kNoGround, kDt);
    ASSERT_LT(energy(spec, next), energy(spec, state)) << k;
    state = next;
  }
}

TEST(Quadrotor, StepsAreOfFourthOrder) {
  const QuadrotorSpec spec;
  QuadrotorState begin = tumbling();
  begin.thrust = {3.0, 3.2, 3.1, 3.3};
  const Rotors command{4.0, 3.0, 3.5, 3.4};
  const QuadrotorState exact = after(spec, begin, command, 0.4, 1e-4);
  const double coarse = (after(spec, begin, command, 0.4, 4e-3).p - exact.p).norm();
  const double fine = (after(spec, begin, command, 0.4, 2e-3).p - exact.p).norm();
  EXPECT_GT(coarse / fine, 12.0);
  EXPECT_LT(coarse / fine, 20.0);
}

TEST(Quadrotor, StandsOnTheGroundUntilThrustExceedsWeight) {
  const QuadrotorSpec spec;
  QuadrotorState state = standing(spec, Vec3(1, 1, 0.2), 0.5);
  const Vec3 wind(10.0, 0.0, 0.0);
  Rotors command;
  command.fill(0.99 * spec.mass_kg * kGravity / 4.0);
  for (int k = 0; k < 1000; ++k) state = step(spec, state, command, wind, 0.2, kDt);
  EXPECT_TRUE(state.on_ground);
  EXPECT_EQ(state.p, Vec3(1, 1, 0.2));
  command.fill(1.2 * spec.mass_kg * kGravity / 4.0);
  for (int k = 0; k < 1000; ++k) state = step(spec, state, command, Vec3::Zero(), 0.2, kDt);
  EXPECT_FALSE(state.on_ground);
  EXPECT_GT(state.p.z(), 0.5);
}

TEST(Quadrotor, WhoFallsOnTheGroundStandsThereLevel) {
  QuadrotorState state = tumbling();
  state.p.z() = 3.0;
  for (int k = 0; k < 5000; ++k) state = step(QuadrotorSpec{}, state, {}, Vec3::Zero(), 0.0, kDt);
  EXPECT_TRUE(state.on_ground);
  EXPECT_EQ(state.p.z(), 0.0);
  EXPECT_EQ(state.v, Vec3::Zero());
  EXPECT_NEAR((state.q * Vec3::UnitZ()).z(), 1.0, 1e-12);
}

RC_GTEST_PROP(Allocation, StaysWithinTheRotorsLimits, ()) {
  const auto number = [](double scale) { return scale * (*rc::gen::inRange(-1000, 1001)) / 1000.0; };
  const QuadrotorSpec spec = quadrotor_spec(*rc::gen::element(QuadrotorClass::Camera, QuadrotorClass::Racer));
  const Wrench wanted{number(100.0), Vec3(number(20.0), number(20.0), number(20.0))};
  for (const double thrust : allocate(spec, wanted)) {
    RC_ASSERT(thrust <= spec.max_thrust());
    RC_ASSERT(thrust >= spec.least_thrust * spec.max_thrust());
  }
}

RC_GTEST_PROP(Allocation, GivesWhatCanBeHad, ()) {
  const QuadrotorSpec spec = quadrotor_spec(*rc::gen::element(QuadrotorClass::Camera, QuadrotorClass::Racer));
  Rotors thrust{};
  for (double& t : thrust) t = spec.max_thrust() * (*rc::gen::inRange(50, 999)) / 1000.0;
  const Rotors again = allocate(spec, wrench_of(spec, thrust));
  for (std::size_t k = 0; k < 4; ++k) RC_ASSERT(std::abs(again[k] - thrust[k]) < 1e-9);
}

TEST(Allocation, GivesUpHeadingBeforeHeight) {
  const QuadrotorSpec spec;
  const double most = 4.0 * spec.max_thrust();
  const Wrench had = wrench_of(spec, allocate(spec, {most, Vec3(0.0, 0.0, 1.0)}));
  EXPECT_NEAR(had.thrust, most, 1e-9);
  EXPECT_NEAR(had.torque.z(), 0.0, 1e-9);
}

TEST(Allocation, GivesUpHeightBeforeTilt) {
  const QuadrotorSpec spec;
  const Wrench had = wrench_of(spec, allocate(spec, {4.0 * spec.max_thrust(), Vec3(0.3, -0.2, 0.0)}));
  EXPECT_LT((had.torque - Vec3(0.3, -0.2, 0.0)).norm(), 1e-9);
}

/// Otherwise a fast turn at little thrust lifts the vehicle, which then needs less thrust and turns faster still.
TEST(Allocation, RaisesThrustForTorqueAtMostHalfTheWayToHovering) {
  for (const auto kind : {QuadrotorClass::Camera, QuadrotorClass::Racer}) {
    const QuadrotorSpec spec = quadrotor_spec(kind);
    const double hover = spec.mass_kg * kGravity, much = spec.max_thrust() * spec.arm_m;
    for (const double share : {0.0, 0.3, 0.9, 1.5}) {
      const Wrench had = wrench_of(spec, allocate(spec, {share * hover, Vec3(2.0 * much, 0.0, 0.0)}));
      EXPECT_LE(had.thrust, std::max(share, 0.5 * (share + 1.0)) * hover + 1e-9) << share;
      EXPECT_GT(had.torque.x(), 0.3 * much) << "it must be able to turn at any thrust; " << share;
      EXPECT_NEAR(had.torque.y(), 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace tern
