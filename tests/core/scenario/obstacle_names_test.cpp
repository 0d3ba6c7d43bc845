#include "core/scenario/obstacle_names.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

using Names = std::map<std::int64_t, std::string>;

std::string world_of(const std::string& generator, int count) {
  return "name: gate\nseed: 1\nworld:\n  generator: " + generator + "\n  count: " + std::to_string(count) +
         "\n  obstacles:\n"
         "    -\n      name: \"\"\n      half_extents: [0.3, 0.3, 1]\n      motion: static\n"
         "    -\n      name: \"gate: \\\"left\\\"\"\n      motion: static\n"
         "    -\n      name: passer\n      motion: wave\n"
         "  recorded:\n    -\n      name: people\n"
         "uav:\n  routes:\n    -\n      name: north\n";
}

TEST(ObstacleNames, AreThoseThatTheScenarioLists) {
  EXPECT_EQ(obstacle_names(world_of("none", 0)), (Names{{1, "gate: \"left\""}, {2, "passer"}}));
  EXPECT_EQ(obstacle_names(""), Names{});
  EXPECT_EQ(obstacle_names("world:\n  obstacles: []\nuav:\n  name: x\n"), Names{});
}

TEST(ObstacleNames, CountTheGeneratedObstaclesFirst) {
  EXPECT_EQ(obstacle_names(world_of("paper_corridor", 300)), (Names{{301, "gate: \"left\""}, {302, "passer"}}));
  EXPECT_EQ(obstacle_names(world_of("blind_corner", 4)), (Names{{19, "gate: \"left\""}, {20, "passer"}}));
  EXPECT_EQ(obstacle_names(world_of("step_aside", 0)), Names{}) << "its number is drawn";
}

TEST(ObstacleNames, AreThoseOfTheNotesAsWell) {
  const std::string notes =
      "# " + name_note(7, "hall: people#142") + "\n# obstacle x: y\n# obstacle 8\n# obstacle : z\n";
  EXPECT_EQ(obstacle_names(world_of("none", 0) + notes),
            (Names{{1, "gate: \"left\""}, {2, "passer"}, {7, "hall: people#142"}}));
}

TEST(ObstacleNames, FollowTheIds) {
  const Names names{{3, "gate"}};
  EXPECT_EQ(with_name(3, names), "3 'gate'");
  EXPECT_EQ(with_name(4, names), "4");
}

}  // namespace
}  // namespace tern
