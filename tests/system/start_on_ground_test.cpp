// A vehicle that stands on the ground of its world or of its map leaves it.
#include <gtest/gtest.h>

#include <fstream>

#include "campaign/experiments/scenario_view.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

/// Ground of a map as a scan makes it: voxels from -0.25 to 0.25 m.
constexpr const char* kScanned =
    "semantics:\n  classes: {ground: occupied}\n"
    "  regions: [{name: field, class: ground, box: {min: [-2, -3, -0.02], max: [14, 3, 0.02]}}]\n";
constexpr const char* kFloor =
    "world: {obstacles: [{name: floor, centre: [10, 0, -0.5], half_extents: [20, 20, 0.5]}]}\n";

/// Writes the scenario of a vehicle whose centre starts at height z, and returns its file.
std::string scenario_at(const TempFolder& folder, double z, const std::string& ground) {
  const std::string file = folder.file("start.yaml");
  std::ofstream(file) << "uav: {start: [0, 0, " << z << "], goal: [6, 0, 1], limits: {v_max: 3, a_max: 5}, "
                      << "body: {radius: 0.3}, flight_box: {min: [-2, -3, -1], max: [14, 3, 4]}}\n"
                      << ground;
  return file;
}

struct Start {
  const char* name;
  double z;
  const char* ground;
};

class StartOnGround : public ::testing::TestWithParam<Start> {};

TEST_P(StartOnGround, IsLeft) {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = scenario_at(folder, GetParam().z, GetParam().ground);
  EXPECT_TRUE(view_scenario(inputs, std::nullopt).shortest);
  const VirtualFlight flight = fly_virtually(inputs.scenario_file, {});
  expect_reached(flight.result);
  EXPECT_EQ(flight.reasons[static_cast<std::size_t>(PlanReason::StartInCollision)], 0);
}

INSTANTIATE_TEST_SUITE_P(Ground, StartOnGround,
                         ::testing::Values(Start{"in_its_voxels", 0.32, kScanned},
                                           Start{"on_its_voxels", 0.55, kScanned},
                                           Start{"deep_in_its_voxels", 0.3, kScanned}, Start{"on_a_box", 0.3, kFloor}),
                         [](const auto& start) { return std::string(start.param.name); });

/// The tube reaches into what the vehicle stands on or beside: the planner has no way to promise, and check says so.
TEST(StartInTheTube, IsRefusedByTheCheckAndStandsForTheReasonThatItGives) {
  for (const auto& [z, ground] : {std::pair(0.55, kScanned), std::pair(0.3, kFloor), std::pair(0.5, kFloor)}) {
    const TempFolder folder;
    FlightInputs inputs;
    inputs.scenario_file = scenario_at(folder, z, ground);
    inputs.overrides = {"executor.tube_m=0.3", "timeout_s=3"};
    const std::string blocked = view_scenario(inputs, std::nullopt).blocked;
    EXPECT_NE(blocked.find("with executor.tube_m 0.3 around the body"), std::string::npos) << z << ": " << blocked;
    const VirtualFlight flight = fly_virtually(inputs.scenario_file, inputs.overrides);
    EXPECT_EQ(flight.result.outcome, FlightOutcome::Timeout) << z;
    EXPECT_GT(flight.reasons[static_cast<std::size_t>(PlanReason::StartInCollision)], 0) << z;
    inputs.overrides = {"executor.tube_m=0.1"};
    const bool is_clear = ground == kFloor && z == 0.5;
    EXPECT_EQ(view_scenario(inputs, std::nullopt).shortest.has_value(), is_clear) << z;
  }
}

TEST(StartInTheGround, IsRefusedByTheCheckAndEndsTheFlight) {
  for (const auto& [z, ground] : {std::pair(0.1, kScanned), std::pair(0.28, kFloor)}) {
    const TempFolder folder;
    FlightInputs inputs;
    inputs.scenario_file = scenario_at(folder, z, ground);
    EXPECT_NE(view_scenario(inputs, std::nullopt).blocked.find("the start lies in"), std::string::npos) << z;
    EXPECT_EQ(fly_virtually(inputs.scenario_file, {}).result.outcome, FlightOutcome::Collision) << z;
  }
}

}  // namespace
}  // namespace tern::testing
