#include "campaign/experiments/scenario_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_folder.h"

namespace tern {
namespace {

using ::testing::HasSubstr;

ScenarioView view_of(const std::string& start) {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = folder.file("a.yaml");
  std::ofstream(inputs.scenario_file)
      << "uav: {start: " << start << ", goal: [9, 0, 1]}\n"
      << "world:\n  obstacles:\n"
      << "    - {name: passer, centre: [0, 0, 1], half_extents: [0.5, 0.5, 1], motion: linear, velocity: [0, 1, 0]}\n";
  return view_scenario(inputs, std::nullopt);
}

TEST(ScenarioView, SaysInWhichObstacleTheStartLies) {
  const ScenarioView inside = view_of("[0, 0, 1]");
  EXPECT_FALSE(inside.shortest);
  EXPECT_THAT(to_text(inside), HasSubstr("the start lies in obstacle 0 'passer'"));
  EXPECT_THAT(draw_scenario(inside), HasSubstr("the goal cannot be reached"));
  const ScenarioView beside = view_of("[-3, 0, 1]");
  EXPECT_TRUE(beside.shortest);
  EXPECT_THAT(to_text(beside), HasSubstr("can be reached"));
}

}  // namespace
}  // namespace tern
