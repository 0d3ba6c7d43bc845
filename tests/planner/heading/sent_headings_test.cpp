#include "planner/heading/sent_headings.h"

#include <gtest/gtest.h>

#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kZero{1'700'000'000'000'000};

PlanHeading turning_to(double yaw, UTime start) {
  PlanHeading heading;
  heading.start = start;
  heading.control_points = {0.0, 0.0, 0.0, yaw / 2, yaw, yaw, yaw};
  return heading;
}

TEST(SentHeadings, AnswerWithTheNewestHeadingOfTheCommittedTrajectory) {
  const TimedSpline one = resting_at(Vec3(0, 0, 1), kZero), other = resting_at(Vec3(1, 0, 1), kZero);
  SentHeadings sent;
  const HorizonRequest request = request_at(kZero + Duration{400'000}, one);
  EXPECT_FALSE(sent.committed_at(request));
  sent.add(one, turning_to(1.0, kZero));
  sent.add(other, turning_to(2.0, kZero));
  EXPECT_EQ(sent.committed_at(request)->yaw, HeadingSpline(turning_to(1.0, kZero)).sample(request.t_s).yaw);
  EXPECT_GT(sent.committed_at(request)->rate, 0.0);
  sent.add(one, turning_to(3.0, kZero + Duration{50'000}));
  EXPECT_EQ(sent.committed_at(request)->yaw,
            HeadingSpline(turning_to(3.0, kZero + Duration{50'000})).sample(request.t_s).yaw);
}

TEST(SentHeadings, KnowNothingOfATrajectoryThatDiffersInOneBit) {
  TimedSpline trajectory = resting_at(Vec3(0, 0, 1), kZero);
  SentHeadings sent;
  sent.add(trajectory, turning_to(1.0, kZero));
  trajectory.control_points(0, 3) += 1e-15;
  EXPECT_FALSE(sent.committed_at(request_at(kZero, trajectory)));
}

}  // namespace
}  // namespace tern
