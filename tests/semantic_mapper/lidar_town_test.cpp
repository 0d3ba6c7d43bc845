// The scanned house of scenarios/lidar_town.yaml, from its real point cloud.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/world/box_cover.h"
#include "planner/global_path/goal_field.h"
#include "planner/global_path/local_goal.h"
#include "runtime/scenario_file.h"
#include "semantic_mapper/app/load_map.h"
#include "tests/support/path_length.h"

namespace tern {
namespace {

TEST(LidarTown, TheHouseStandsInTheWayAndCanBePassed) {
  auto document = ConfigDocument::load(TERN_SCENARIO_FOLDER "/lidar_town.yaml", {});
  const Scenario scenario = read_scenario(document);
  const VoxelMap map = load_map(scenario, read_mapper_config(document.root().section("mapper")), TERN_DATA_FOLDER).map;
  EXPECT_GT(std::count(map.labels.begin(), map.labels.end(), VoxelLabel::Occupied), 100'000);

  std::vector<Box> boxes = cover_with_boxes(map, false);
  for (Box& box : boxes) box = grown(box, Vec3::Constant(0.25));
  const BoxIndex index(boxes);
  const UavSpec& uav = scenario.uav;
  EXPECT_FALSE(index.covers(uav.start));
  EXPECT_FALSE(index.covers(uav.goal));
  EXPECT_TRUE(index.blocks(uav.start, uav.goal));

  GoalFieldOptions options;
  options.start = uav.start;
  const Vec3 body = uav.body.half_extents();
  const Box centre_box(uav.flight_box.min() + body, uav.flight_box.max() - body);
  const auto path = GoalField::build(boxes, centre_box, uav.goal, options).path_from(uav.start);
  ASSERT_TRUE(path);
  EXPECT_LT(path_length(*path), 40.0);
  for (std::size_t i = 1; i < path->size(); ++i) EXPECT_FALSE(index.blocks((*path)[i - 1], (*path)[i]));
}

}  // namespace
}  // namespace tern
