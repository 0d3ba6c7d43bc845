#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>

#include "campaign/experiments/scenario_drawing.h"
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

TEST(ScenarioView, DrawsAPageOnWhichItsTextsHaveRoom) {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = folder.file("along_y.yaml");
  std::ofstream(inputs.scenario_file)
      << "uav: {start: [0, 0, 1], goal: [0, 30, 1], flight_box: {min: [-2, -3, 0], max: [2, 33, 3]}}\n";
  const std::string drawing = draw_scenario(view_scenario(inputs, std::nullopt));
  std::smatch page;
  ASSERT_TRUE(std::regex_search(drawing, page, std::regex("<svg [^>]*width=\"([0-9.]+)\"")));
  const double width = std::stod(page[1]);
  const std::regex text("<text x=\"([0-9.]+)\"[^>]*font-size=\"([0-9.]+)\"[^>]*>([^<]*)</text>");
  int texts = 0;
  for (std::sregex_iterator t(drawing.begin(), drawing.end(), text); t != std::sregex_iterator(); ++t, ++texts) {
    EXPECT_LT(std::stod((*t)[1]) + 0.5 * std::stod((*t)[2]) * static_cast<double>((*t)[3].length()), width) << (*t)[3];
  }
  EXPECT_GE(texts, 2);
}

TEST(ScenarioView, ShowsWhoIsThereAndHowHighRegionsAre) {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = folder.file("a.yaml");
  std::ofstream(inputs.scenario_file)
      << "uav: {start: [0, 0, 1], goal: [9, 0, 1]}\n"
      << "world:\n  obstacles:\n"
      << "    - {centre: [5, 3, 1], half_extents: [0.5, 0.5, 1]}\n"
      << "    - {motion: waypoints, vanish: true, points: [[-1, 3, 5, 1], [9, 3, 9, 1]]}\n"
      << "    - {motion: waypoints, vanish: true, points: [[4, 90, 5, 1], [9, 3, 5, 1]]}\n"
      << "semantics:\n  classes: {garden: repulsive}\n"
      << "  regions: [{name: roses, class: garden, box: {min: [4, -1, 0], max: [6, 1, 2.5]}}]\n";
  const ScenarioView view = view_scenario(inputs, std::nullopt);
  EXPECT_THAT(to_text(view), HasSubstr("2 obstacles: 1 rest, 1 move; 1 more appear later"));
  EXPECT_THAT(to_text(view), HasSubstr("roses (garden, repulsive, λ 2), z 0 to 2.5 m:"));
  EXPECT_THAT(draw_scenario(view), HasSubstr(">roses, z 0 to 2.5 m<"));
  EXPECT_THAT(draw_scenario(view), Not(HasSubstr(">80<")));  ///< the axis does not reach obstacles that appear later
}

ScenarioView view_of_scenario(const std::string& yaml) {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = folder.file("a.yaml");
  std::ofstream(inputs.scenario_file) << yaml;
  return view_scenario(inputs, std::nullopt);
}

TEST(ScenarioView, SaysThatTheStartLiesInAnUnknownVoxel) {
  const std::string yaml =
      "uav: {start: [0, 0, 1], goal: [9, 0, 1], body: {radius: 0.3}, flight_box: {min: [-2, -3, 0], max: [12, 3, 3]}}\n"
      "mapper: {background: unknown, extents: {min: [-2, -3, 0], max: [12, 3, 3]}}\n";
  EXPECT_TRUE(view_of_scenario(yaml).shortest);
  EXPECT_THAT(to_text(view_of_scenario(yaml + "planner: {unknown: obstacle}\n")),
              HasSubstr("cannot be reached: the start lies in the unknown voxel at ("));
}

TEST(ScenarioView, RefusesASensorThatIsLaterThanTheWorldMayBe) {
  const std::string uav = "uav: {start: [0, 0, 1], goal: [9, 0, 1]}\n";
  const std::string late = "simulator: {declare: false, sensor: {mode: noisy, latency_s: 0.28}}\n";
  EXPECT_THAT(to_text(view_of_scenario(uav + late)),
              ::testing::AllOf(HasSubstr("cannot be reached: the newest detection is 0.32 s old on average"),
                               HasSubstr("planner.stale_after_s, 0.3 s")));
  EXPECT_TRUE(view_of_scenario(uav + late + "planner: {stale_after_s: 0.5}\n").shortest);
  EXPECT_TRUE(view_of_scenario(uav + "simulator: {sensor: {mode: noisy, latency_s: 0.28}}\n").shortest)
      << "declared motions are fresh";
  EXPECT_TRUE(view_of_scenario(uav + "simulator: {declare: false, sensor: {mode: noisy}}\n").shortest);
}

TEST(ScenarioView, WarnsOfAccelerationsThatTheVehicleCannotGive) {
  const std::string uav = "uav: {start: [0, 0, 1], goal: [9, 0, 1], ";
  const std::string camera = "simulator: {vehicle: quadrotor}\n";  // thrust/weight 2
  EXPECT_THAT(to_text(view_of_scenario(uav + "limits: {a_max: 12}}\n" + camera)),
              HasSubstr("WARNING     uav.limits.a_max [12, 12, 12] takes a thrust of up to 27.6 m/s², and the vehicle "
                        "has 19.6 m/s² (thrust_to_weight 2)"));
  EXPECT_THAT(to_text(view_of_scenario(uav + "dynamics: {thrust_max: 30}}\n" + camera)),
              HasSubstr("uav.dynamics.thrust_max is 30 m/s²"));
  EXPECT_THAT(to_text(view_of_scenario(uav + "dynamics: {}}\n" + camera)), Not(HasSubstr("WARNING")));
  EXPECT_THAT(to_text(view_of_scenario(uav + "limits: {a_max: 3}}\n" + camera)), Not(HasSubstr("WARNING")));
  EXPECT_THAT(to_text(view_of_scenario(uav + "limits: {a_max: 12}}\n")), Not(HasSubstr("WARNING")));
}

/// A wall across the flight box, of two parts.
std::string blocked_by(const std::string& wall) {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = folder.file("a.yaml");
  std::ofstream(inputs.scenario_file)
      << "uav: {start: [0, 0, 1], goal: [9, 0, 1], flight_box: {min: [-2, -3, 0], max: [12, 3, 3]}}\n"
      << wall;
  return view_scenario(inputs, std::nullopt).blocked;
}

TEST(ScenarioView, CallsWhatBlocksTheGoalByItsName) {
  EXPECT_THAT(
      blocked_by("world: {obstacles: [{name: gate, centre: [5, 0, 1.5], half_extents: [0.2, 3, 1.5]}]}\n"),
      HasSubstr("obstacle 'gate' from (4.80, -3.00, 0.00) to (5.20, 3.00, 3.00) is the first to block the way"));
  EXPECT_THAT(blocked_by("world: {obstacles: [{centre: [5, 0, 1.5], half_extents: [0.2, 3, 1.5]}]}\n"),
              HasSubstr("an obstacle from"));
  const std::string regions =
      "    - {name: facade, class: wall, box: {min: [4.8, -3, 0], max: [5.2, 3, 3]}}\n"
      "    - {name: elsewhere, class: wall, box: {min: [10.5, 2, 0], max: [11, 2.5, 1]}}\n"
      "    - {name: meadow, class: grass, box: {min: [4, -3, 0], max: [6, 3, 3]}}\n";
  const std::string by_map =
      blocked_by("semantics:\n  classes: {wall: occupied, grass: attractive}\n  regions:\n" + regions);
  EXPECT_THAT(by_map, HasSubstr("an occupied part of the map (region 'facade') from"));
}

/// A room: floor, ceiling and a wall as occupied regions of the map; the vehicle flies above the floor, along x.
ScenarioView room() {
  const TempFolder folder;
  FlightInputs inputs;
  inputs.scenario_file = folder.file("room.yaml");
  std::ofstream(inputs.scenario_file)
      << "uav: {start: [0, 0, 1], goal: [9, 0, 1], flight_box: {min: [-2, -3, 0], max: [12, 3, 3]}}\n"
      << "world:\n  obstacles:\n"
      << "    - {name: gate, centre: [5, 2, 1], half_extents: [0.2, 0.5, 1]}\n"
      << "    - {name: lamp, centre: [5, 1, 2.6], half_extents: [0.2, 0.2, 0.2]}\n"
      << "    - {name: passer, centre: [3, -2, 1], half_extents: [0.2, 0.2, 1], motion: linear, velocity: [0.1, 0, "
         "0]}\n"
      << "mapper: {resolution_m: 0.25}\n"
      << "semantics:\n  classes: {house: occupied}\n  regions:\n"
      << "    - {name: floor, class: house, box: {min: [-2, -3, 0], max: [12, 3, 0.25]}}\n"
      << "    - {name: ceiling, class: house, box: {min: [-2, -3, 2.75], max: [12, 3, 3]}}\n"
      << "    - {name: wall, class: house, box: {min: [-2, 2.5, 0], max: [12, 3, 3]}}\n";
  return view_scenario(inputs, std::nullopt);
}

/// Returns the widest rectangle of a fill in the part of the drawing between two texts, and its height, pixels.
std::pair<double, double> largest_rect(const std::string& drawing, const std::string& from, const std::string& to,
                                       const std::string& fill) {
  const std::size_t begin = drawing.find(from);
  const std::string part = drawing.substr(begin, drawing.find(to, begin) - begin);
  const std::regex rect("<rect [^>]*width=\"([0-9.]+)\" height=\"([0-9.]+)\" " + fill);
  std::pair<double, double> largest{0.0, 0.0};
  for (std::sregex_iterator r(part.begin(), part.end(), rect); r != std::sregex_iterator(); ++r) {
    largest = std::max(largest, {std::stod((*r)[1]), std::stod((*r)[2])});
  }
  return largest;
}

TEST(ScenarioView, DrawsARoomAtTheVehiclesHeightAndFromTheSide) {
  const ScenarioView view = room();
  ASSERT_TRUE(view.shortest) << view.blocked;
  const auto [low, high] = drawn_heights(view);
  EXPECT_NEAR(low, 0.9, 0.05);
  EXPECT_NEAR(high, 1.1, 0.05);
  const std::string drawing = draw_scenario(view);
  const double metre = 1000.0 / 18.0;  ///< pixels, for 14 m and 2 m on either side
  const auto wall = largest_rect(drawing, ">from above<", ">from the side", "fill=\"#4a5560\"");
  EXPECT_NEAR(wall.first, 14.0 * metre, 2.0);
  EXPECT_NEAR(wall.second, 0.5 * metre, 2.0) << "neither floor nor ceiling fills the room";
  const auto side = largest_rect(drawing, ">from the side", "</svg>", "fill=\"#4a5560\"");
  EXPECT_NEAR(side.first, 14.0 * metre, 2.0);
  EXPECT_LT(side.second, 0.6 * metre) << "floor and ceiling; the wall is beside the path";
  EXPECT_EQ(largest_rect(drawing, ">from the side", "</svg>", "fill=\"#7d838c\"").first, 18.0) << "the key's alone";
}

TEST(ScenarioView, DrawsNamesAndWaysAndAKeyOfThem) {
  const std::string drawing = draw_scenario(room());
  for (const char* text :
       {">gate<", ">lamp<", ">passer<", ">start<", ">goal<", ">from above<", ">from the side, along the path<",
        ">their ways during the first 10 s<", ">static obstacles above or below<", ">moving obstacles at time 0<"}) {
    EXPECT_THAT(drawing, HasSubstr(text));
  }
  EXPECT_THAT(drawing, HasSubstr(">occupied in the map from 0.9 to 1.1 m, the vehicle's height<"));
  EXPECT_THAT(drawing, HasSubstr("fill=\"none\" stroke=\"#e07b00\"")) << "the way of the passer";
}

}  // namespace
}  // namespace tern
