#include "planner/global_path/local_goal.h"

#include <gtest/gtest.h>

#include "tests/support/path_length.h"

namespace tern {
namespace {

TEST(LocalGoal, IsTheGoalWhenTheGoalIsInTheSphere) {
  EXPECT_EQ(local_goal({Vec3(0, 0, 0), Vec3(3, 0, 0)}, Vec3(0, 0, 0), 4.0), Vec3(3, 0, 0));
  EXPECT_EQ(local_goal({Vec3(1, 2, 3)}, Vec3(1, 2, 3), 4.0), Vec3(1, 2, 3)) << "a path of one point";
  EXPECT_EQ(local_goal({Vec3(0, 0, 0), Vec3(4, 0, 0)}, Vec3(0, 0, 0), 4.0), Vec3(4, 0, 0)) << "on the sphere";
}

TEST(LocalGoal, IsWhereThePathLeavesTheSphere) {
  const Vec3 goal = local_goal({Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 20, 0)}, Vec3(0, 0, 0), 5.0);
  EXPECT_LT((goal - Vec3(3, 4, 0)).norm(), 1e-12);
}

TEST(LocalGoal, IsTheLastExitOfAPathThatComesBack) {
  const std::vector<Vec3> path{Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(10, 2, 0), Vec3(-10, 2, 0)};
  const Vec3 goal = local_goal(path, Vec3(0, 0, 0), 4.0);
  EXPECT_LT((goal - Vec3(-std::sqrt(12.0), 2, 0)).norm(), 1e-12);
}

TEST(LocalGoal, LooksTowardsAPathThatItDoesNotTouch) {
  EXPECT_EQ(local_goal({Vec3(10, 0, 0), Vec3(20, 0, 0)}, Vec3(0, 0, 0), 4.0), Vec3(4, 0, 0));
}

TEST(PathLength, SumsItsSegments) {
  EXPECT_EQ(path_length({Vec3(0, 0, 0), Vec3(3, 4, 0), Vec3(3, 4, 2)}), 7.0);
  EXPECT_EQ(path_length({Vec3(1, 1, 1)}), 0.0);
}

}  // namespace
}  // namespace tern
