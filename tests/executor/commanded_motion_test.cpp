// A vehicle reconstructs the executor's exact curve from setpoints and committed trajectories.
#include "executor/commanded_motion.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/base/random.h"
#include "executor/executor.h"
#include "tests/support/straight_plan.h"

namespace tern {
namespace {

constexpr UTime kZero{1'700'000'000'000'000};
constexpr Duration kBeat{10'000};

UavSpec uav() {
  UavSpec uav;
  uav.start = Vec3(0.0, 0.0, 1.0);
  uav.limits.j_max = Vec3::Constant(60.0);
  return uav;
}

UavState setpoint(UTime at, const MotionSample& motion) {
  UavState state;
  state.at = at;
  state.motion = motion;
  return state;
}

/// An executor that flies straight plans, and the command of a vehicle that receives each setpoint unless `lost` is
/// true.
class Flight {
 public:
  template <class Lost>
  void fly(Duration span, const Lost& lost) {
    const UTime end = now_ + span;
    for (; now_ < end; now_ = now_ + kBeat) {
      if (const auto request = executor_.next_request(now_)) {
        command_.receive(request->committed);
        executor_.consider(straight_plan(*request, Vec3(30.0, -4.0, 3.0)), now_ + Duration{5'000});
      }
      UTime at = now_ - kBeat;
      for (const CubicPiece& piece : executor_.pieces(at, now_).pieces) {
        at = at + piece.duration;
        if (!lost()) command_.receive(setpoint(at, executor_.sample_after(at)));
      }
    }
  }
  void expect_same_until(UTime to) {
    for (UTime t = kZero; t <= to; t = t + Duration{1'700}) {
      const MotionSample a = command_.sample(t), b = executor_.sample(t);
      ASSERT_LT((a.p - b.p).norm(), 1e-9) << (t - kZero).us;
      ASSERT_LT((a.v - b.v).norm(), 1e-8);
      ASSERT_LT((a.a - b.a).norm(), 1e-6);
    }
  }

  UTime now_ = kZero;
  Executor executor_ = [] {
    Executor executor(uav(), kZero - Duration{300'000});
    executor.begin(kZero);
    executor.set_mode(GoalMode::Go);
    return executor;
  }();
  CommandedMotion command_{uav().start, kZero - Duration{300'000}, uav().limits};
};

TEST(CommandedMotion, IsTheCommittedCurveBetweenSetpoints) {
  Flight flight;
  flight.fly(Duration{3'000'000}, [] { return false; });
  EXPECT_GT(flight.command_.sample(flight.now_).v.norm(), 1.0);
  flight.expect_same_until(flight.command_.settled().end());
}

TEST(CommandedMotion, IsTheCommittedCurveThoughHalfTheSetpointsAreLost) {
  Flight flight;
  Rng rng(3);
  flight.fly(Duration{3'000'000}, [&] { return rng.uniform() < 0.5; });
  flight.expect_same_until(flight.command_.settled().end());
}

TEST(CommandedMotion, GoesOnAlongTheCommittedCurveToItsRestWhenTheExecutorDies) {
  for (int k = 0; k < 40; ++k) {
    Flight flight;
    flight.fly(Duration{600'000 + k * 17'000}, [] { return false; });
    const UTime died = flight.command_.settled().end();
    flight.command_.settle(died + Duration{5'000'000});
    const MotionHistory& motion = flight.command_.settled();
    // A plan adopted after the newest request is unknown to the vehicle, and its start is still ahead.
    const Vec3 end = motion.sample(motion.end()).p;
    EXPECT_EQ(motion.sample(motion.end()).v, Vec3::Zero());
    EXPECT_GT((end - flight.executor_.sample(died).p).norm(), 0.05) << "it did not stop at once";
    flight.expect_same_until(died);
  }
}

TEST(CommandedMotion, BrakesWithinTheLimitsFromASetpointThatIsOnNoCommittedCurve) {
  Rng rng(5);
  const Limits limits = uav().limits;
  for (int k = 0; k < 200; ++k) {
    CommandedMotion command(Vec3::Zero(), kZero, limits);
    MotionSample moving;
    for (int i = 0; i < 3; ++i) {
      moving.p[i] = rng.uniform(-5.0, 5.0);
      moving.v[i] = rng.uniform(-0.5, 0.5) * limits.v_max[i];
      moving.a[i] = rng.uniform(-0.3, 0.3) * limits.a_max[i];
    }
    const double h = 0.5 * kBeat.seconds();  // the jump is accepted when the next setpoint continues it
    MotionSample before = moving;
    before.v -= h * moving.a;
    before.p -= h * moving.v - 0.5 * h * h * moving.a;
    command.receive(setpoint(kZero + Duration{kBeat.us / 2}, before));
    command.receive(setpoint(kZero + kBeat, moving));
    command.settle(kZero + Duration{60'000'000});
    const MotionHistory& motion = command.settled();
    EXPECT_EQ(motion.sample(motion.end()).v, Vec3::Zero());
    for (const CubicPiece& piece : motion.pieces(kZero + kBeat, motion.end()).pieces) {
      const double s = piece.duration.seconds();
      EXPECT_TRUE((max_abs_velocity(piece.coefficients, 0.0, s).array() <= limits.v_max.array() * 1.000002).all());
      EXPECT_TRUE((max_abs_acceleration(piece.coefficients, 0.0, s).array() <= limits.a_max.array() * 1.000002).all());
    }
    EXPECT_LT((motion.sample(kZero + kBeat).p - moving.p).norm(), 1e-9);
  }
}

// A vehicle that was held up reported its state before it received the trajectory in force at that time.
TEST(CommandedMotion, ATrajectoryThatDoesNotJoinTheCommittedOneIsNotTaken) {
  Flight flight;
  flight.fly(Duration{600'000}, [] { return false; });
  const UTime begins = flight.now_ + Duration{1'000'000};
  ASSERT_TRUE(flight.command_.is_committed());
  MotionSample elsewhere = flight.command_.sample(begins);
  elsewhere.v.x() += 0.5;
  flight.command_.receive(braking_trajectory(elsewhere, begins, uav().limits));
  const MotionSample there = flight.command_.sample(begins);
  EXPECT_EQ(there.v.x(), elsewhere.v.x() - 0.5);
}

/// A flight before a turn: a request, and the plan that answers it.
struct Turn {
  explicit Turn(Flight& flight) {
    flight.fly(Duration{2'000'000}, [] { return false; });
    while (!request) {
      request = flight.executor_.next_request(flight.now_);
      if (!request) flight.fly(kBeat, [] { return false; });
    }
    flight.command_.receive(request->committed);
    plan = straight_plan(*request, Vec3(10.0, 20.0, 1.0));
  }
  [[nodiscard]] Vec3 planned_acceleration(UTime t) const {
    return plan.trajectory.spline().sample((t - plan.trajectory.start).seconds()).a;
  }
  std::optional<HorizonRequest> request;
  Plan plan;
};

constexpr Duration kLead{100'000};

TEST(CommandedMotion, LooksAheadAtAPlanBeforeItIsCommittedAndDoesNotFlyIt) {
  Flight flight;
  const Turn turn(flight);
  const UTime now = turn.request->t_s - Duration{1'000}, later = now + kLead;
  const MotionSample committed = flight.command_.sample(later);
  ASSERT_GT((turn.planned_acceleration(later) - committed.a).norm(), 0.5);
  flight.command_.receive(turn.plan);
  EXPECT_EQ(flight.command_.acceleration_ahead(now, kLead), turn.planned_acceleration(later));
  const UTime before = turn.request->t_s - kLead - Duration{1'000};
  EXPECT_EQ(flight.command_.acceleration_ahead(before, kLead), flight.command_.sample(before + kLead).a);
  EXPECT_EQ(flight.command_.sample(later).p, committed.p);
  EXPECT_EQ(flight.command_.sample(later).a, committed.a);
}

TEST(CommandedMotion, APlanThatWasNotCommittedIsForgottenWhenItWasToBegin) {
  Flight flight;
  const Turn turn(flight);
  flight.command_.receive(turn.plan);
  for (UTime t = turn.request->t_s; t < turn.plan.trajectory.end() + kLead; t = t + kBeat) {
    EXPECT_EQ(flight.command_.acceleration_ahead(t, kLead), flight.command_.sample(t + kLead).a);
  }
}

TEST(CommandedMotion, LooksBeyondTheEndOfAPlanThatIsShorterThanTheLead) {
  Flight flight;
  const Turn turn(flight);
  flight.command_.receive(turn.plan);
  const Duration lead = turn.plan.trajectory.end() - turn.plan.trajectory.start + Duration{100'000};
  EXPECT_EQ(flight.command_.acceleration_ahead(turn.request->t_s - Duration{1'000}, lead), Vec3(Vec3::Zero()));
}

TEST(CommandedMotion, WhatIsCommittedTakesThePlaceOfWhatWasPlanned) {
  Flight flight;
  const Turn turn(flight);
  const UTime now = turn.request->t_s - Duration{1'000};
  flight.command_.receive(turn.plan);
  flight.command_.receive(turn.request->committed);
  EXPECT_EQ(flight.command_.acceleration_ahead(now, kLead), flight.command_.sample(now + kLead).a);
}

TEST(CommandedMotion, LooksAtNoPlanThatDoesNotJoinOrIsNone) {
  Flight flight;
  const Turn turn(flight);
  const auto looks_at = [&](const Plan& plan) {
    CommandedMotion command = flight.command_;
    command.receive(plan);
    const UTime now = turn.request->t_s - Duration{1'000};
    return command.acceleration_ahead(now, kLead) != command.sample(now + kLead).a;
  };
  ASSERT_TRUE(looks_at(turn.plan));
  Plan none = turn.plan, kept = turn.plan, elsewhere = turn.plan;
  none.outcome = PlanOutcome::NoPlan;
  kept.outcome = PlanOutcome::KeepCommitted;
  elsewhere.trajectory.control_points.colwise() += Vec3(0.5, 0.0, 0.0);
  for (const Plan& plan : {none, kept, elsewhere}) EXPECT_FALSE(looks_at(plan));
}

TEST(CommandedMotion, AfterASilenceAStreamThatIsFarOffIsFollowedWhenItHasGoneOn) {
  CommandedMotion command(Vec3::Zero(), kZero, uav().limits);
  const MotionSample there{.p = Vec3(2.0, 0.0, 0.0)};
  const UTime begins = kZero + Duration{1'000'000};
  UTime at = begins;
  for (; at < begins + Duration{500'000}; at = at + kBeat) {
    command.settle(at - kSetpointSilence);
    command.receive(setpoint(at, there));
    EXPECT_EQ(command.sample(at).p, Vec3::Zero());
  }
  command.receive(setpoint(at, there));
  EXPECT_EQ(command.sample(at).p, there.p);
}

TEST(CommandedMotion, AfterASilenceAStreamThatIsNearIsFollowedAtOnce) {
  CommandedMotion command(Vec3::Zero(), kZero, uav().limits);
  const MotionSample there{.p = Vec3(0.05, 0.0, 0.0)};
  const UTime begins = kZero + Duration{1'000'000};
  command.receive(setpoint(begins, there));
  EXPECT_EQ(command.sample(begins).p, Vec3::Zero());
  command.receive(setpoint(begins + kBeat, there));
  EXPECT_EQ(command.sample(begins + kBeat).p, there.p);
}

TEST(CommandedMotion, ASetpointThatComesAfterItWasGivenUpForIsIgnored) {
  CommandedMotion command(Vec3::Zero(), kZero, uav().limits);
  EXPECT_TRUE(command.settle(kZero + kBeat * 5));
  EXPECT_FALSE(command.settle(kZero + kBeat * 5));
  command.receive(setpoint(kZero + kBeat * 3, MotionSample{.p = Vec3(9, 9, 9)}));
  EXPECT_EQ(command.sample(kZero + kBeat * 3).p, Vec3::Zero());
  EXPECT_EQ(command.settled().end(), kZero + kBeat * 5);
}

}  // namespace
}  // namespace tern
