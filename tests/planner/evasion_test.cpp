// A vehicle at rest in open space evades an obstacle that comes straight at it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/plan_judge.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kStart{50'000'000};
constexpr double kSeenBefore = 1.0;  // s
constexpr double kHalf = 0.4;        // m: a box of 0.8 m

/// Faces and corners of a cube, as unit vectors.
std::vector<Vec3> fourteen_directions() {
  std::vector<Vec3> directions;
  for (int axis = 0; axis < 3; ++axis) {
    directions.emplace_back(Vec3::Unit(axis));
    directions.emplace_back(-Vec3::Unit(axis));
  }
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    directions.push_back(corner.normalized());
  }
  return directions;
}

struct Encounter {
  double least_gap = INFINITY;  ///< m, over the whole passage
  bool evaded = false;          ///< at least one answer was an evasion or a new plan
};

/// The centre of the box comes from `direction` at `speed`, and would reach the vehicle's centre 1 s after it is first
/// predicted. A loop at 10 Hz flies the plans.
Encounter meet(const Vec3& direction, double speed, GoalMode mode) {
  const Vec3 home(0, 0, 50);
  PlannerConfig config;
  Loop loop{kStart, resting_at(home, kStart - Duration{1'000'000}), Limits{}, Body{}, config, Duration{100'000}};
  const Track intruder =
      straight_mover(1, home + direction * (speed * kSeenBefore), -speed * direction, kHalf, kStart, 8.0);
  Goal goal = go_to(home);
  goal.mode = mode;
  const PlanningWorld first = world_of({}, goal, request_at(kStart, loop.committed));
  Encounter encounter;
  while (loop.t_s < kStart + Duration{1'500'000}) {
    const UTime from = loop.t_s;
    const Plan answer = loop.step([&](const HorizonRequest& request) {
      PlanningWorld world = first;
      TrackSet set;
      set.made_at = request.header.utime;
      set.tracks = {intruder};
      world.predictions = std::make_shared<const PredictionProducts>(std::move(set));
      return world;
    });
    encounter.evaded =
        encounter.evaded || (answer.outcome != PlanOutcome::KeepCommitted && answer.outcome != PlanOutcome::NoPlan);
    for (UTime t = from; t < loop.t_s; t = t + Duration{2'000}) {
      encounter.least_gap =
          std::min(encounter.least_gap, gap(loop.body, loop.committed.sample(t).p, promised_box(intruder, t)));
    }
  }
  return encounter;
}

class EvasionFrom : public ::testing::TestWithParam<double> {};

TEST_P(EvasionFrom, AVehicleAskedToHoldGetsOutOfTheWay) {
  for (const Vec3& direction : fourteen_directions()) {
    const Encounter encounter = meet(direction, GetParam(), GoalMode::Hold);
    EXPECT_TRUE(encounter.evaded) << "from " << direction.transpose();
    EXPECT_GT(encounter.least_gap, 0.0) << "from " << direction.transpose();
  }
}

TEST_P(EvasionFrom, AVehicleAtRestAtItsGoalGetsOutOfTheWay) {
  for (const Vec3& direction : fourteen_directions()) {
    const Encounter encounter = meet(direction, GetParam(), GoalMode::Go);
    EXPECT_TRUE(encounter.evaded) << "from " << direction.transpose();
    EXPECT_GT(encounter.least_gap, 0.0) << "from " << direction.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(MetresPerSecond, EvasionFrom, ::testing::Values(1.5, 6.0));

}  // namespace
}  // namespace tern
