// Scenario files: written scenarios are read back; every rule refuses with file, line and key.
#include "runtime/scenario_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include "random_scenario.h"
#include "tests/messages/allocation_meter.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

Scenario read(const std::string& yaml) {
  ConfigDocument document = ConfigDocument::parse(yaml, "a.yaml");
  return read_scenario(document);
}

std::string error_of(const std::string& yaml) {
  try {
    read(yaml);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

/// The error of one obstacle, given as the lines under its dash (the first is line 3).
std::string obstacle_error(const std::string& lines) { return error_of("world:\n  obstacles:\n    - " + lines); }

/// The error of one region.
std::string region_error(const std::string& lines) { return error_of("semantics:\n  regions:\n    - " + lines); }

RC_GTEST_PROP(ScenarioFile, ReadsBackWhatItWrites, (std::uint64_t seed)) {
  Rng rng(seed);
  const Scenario scenario = random_scenario(rng);
  const std::string yaml = write_scenario(scenario);
  const std::string differs = difference(read(yaml), scenario);
  RC_LOG() << yaml;
  RC_ASSERT(differs == std::string());
}

RC_GTEST_PROP(ScenarioFile, ReadsBackTheEffectiveConfiguration, (std::uint64_t seed)) {
  Rng rng(seed);
  const Scenario scenario = random_scenario(rng);
  ConfigDocument document = ConfigDocument::parse(write_scenario(scenario), "a.yaml");
  read_scenario(document);
  const std::string differs = difference(read(document.effective()), scenario);
  RC_LOG() << document.effective();
  RC_ASSERT(differs == std::string());
}

TEST(ScenarioFile, EveryScenarioOfTheProjectIsRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TERN_SCENARIOS)) {
    if (entry.path().extension() != ".yaml") continue;
    ConfigDocument document = ConfigDocument::load(entry.path().string(), {});
    EXPECT_NO_THROW(read_scenario(document)) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(ScenarioFile, TheTutorialsExampleIsRead) {
  std::ifstream stream(std::filesystem::path(TERN_SCENARIOS) / "../docs/tutorial.md");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string open = "```yaml\n";
  const std::size_t begin = text.find(open) + open.size();
  const Scenario scenario = read(text.substr(begin, text.find("```", begin) - begin));
  EXPECT_EQ(scenario.name, "courtyard");
  EXPECT_EQ(scenario.world.obstacles.size(), 3U);
  EXPECT_EQ(scenario.semantics.regions.size(), 2U);
}

/// Flips, overwrites, removes, doubles or cuts off some bytes, or inserts characters with a meaning in YAML.
std::string mutated(std::string text, Rng& rng) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n)); };
  constexpr const char* kPieces[] = {"&a ", "*a", "[",      "]",     "{",  "}",    ": ",    "- ", "\n",   "? ",
                                     "| ",  "#",  "!!str ", "---\n", "\"", ".inf", "1e999", "\t", "<<: ", "%"};
  for (std::size_t n = 1 + below(5); n > 0 && !text.empty(); --n) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(1 + below(40), text.size() - at);
    switch (below(6)) {
      case 0: text[at] = static_cast<char>(below(256)); break;
      case 1: text[at] = static_cast<char>(text[at] ^ (1 << below(8))); break;
      case 2: text.erase(at, length); break;
      case 3: text.insert(at, text, below(text.size()), length); break;
      case 4: text.insert(at, kPieces[below(std::size(kPieces))]); break;
      default:
        if (rng.uniform() < 0.2) text.resize(at);
    }
  }
  return text;
}

TEST(ScenarioFile, MutatedIsReadOrRefusedWithItsNameAndTakesLittle) {
  std::vector<std::string> originals;
  for (const auto& entry : std::filesystem::directory_iterator(TERN_SCENARIOS)) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream stream(entry.path());
    originals.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  std::sort(originals.begin(), originals.end());
  Rng rng(7);
  int was_read = 0;
  const int count = support::at_effort(1'000);
  for (int k = 0; k < count; ++k) {
    const std::string yaml = mutated(originals[static_cast<std::size_t>(k) % originals.size()], rng);
    const AllocationMeter meter;
    const std::string error = error_of(yaml);
    was_read += error.empty() ? 1 : 0;
    ASSERT_TRUE(error.empty() || error.rfind("a.yaml", 0) == 0) << k << ": " << error;
    ASSERT_LT(meter.peak(), std::size_t{20} << 20U) << k;
  }
  EXPECT_GT(was_read, 0);
  EXPECT_LT(was_read, count);
}

TEST(ScenarioFile, AnEmptyFileIsAllDefaultsNamedAfterTheFile) {
  Scenario defaults;
  defaults.name = "a";
  EXPECT_EQ(difference(read(""), defaults), "");
}

TEST(ScenarioFile, LeavesProcessSectionsToTheirProcesses) {
  EXPECT_EQ(error_of("planner: {anything: 1}\nsimulator: {}\npredictor:\n"), "");
  EXPECT_EQ(error_of("plannr: {}\n").rfind("a.yaml:1: plannr: unknown key", 0), 0U);
}

TEST(ScenarioFile, ListsEveryTopLevelKeyThatItKnows) {
  EXPECT_EQ(error_of("plannr: {}\n"),
            "a.yaml:1: plannr: unknown key (known here: autopilot_sim, detector, dimos, estimator, executor, features, "
            "logger, mapper, "
            "mavlink, mission, name, planner, predictor, seed, "
            "semantics, simulator, timeout_s, uav, world)");
}

TEST(ScenarioFile, CallsAMisspeltKeyUnknownBeforeItBlamesTheDefaultThatStandsInItsPlace) {
  const auto starts = [](const std::string& yaml, const std::string& text) {
    const std::string error = error_of(yaml);
    EXPECT_EQ(error.rfind(text, 0), 0U) << error;
  };
  starts("uav:\n  start: [500, 0, 1]\n  gaol: [501, 0, 1]\n  flight_box: {min: [490, -9, 0], max: [520, 9, 5]}\n",
         "a.yaml:3: uav.gaol: unknown key");
  starts("world:\n  generatr: sando_forest\n  count: 3\n", "a.yaml:2: world.generatr: unknown key");
  starts("semantics:\n  clases: {moss: attractive}\n  lambdas: {moss: 1}\n", "a.yaml:2: semantics.clases: unknown key");
  starts(
      "semantics:\n  clases: {moss: attractive}\n  regions: [{name: r, class: moss, ball: {centre: [0, 0, 0], radius: "
      "1}}]\n",
      "a.yaml:2: semantics.clases: unknown key");
  starts("semantics:\n  regions:\n    - name: r\n      class: meadow\n      bal: {centre: [0, 0, 0], radius: 1}\n",
         "a.yaml:5: semantics.regions[0].bal: unknown key");
  starts("world:\n  recorded:\n    - file: a\n      colums: 8\n      y_column: 7\n",
         "a.yaml:4: world.recorded[0].colums: unknown key");
  starts(
      "world:\n  obstacles:\n    - motion: waypoints\n      repeat: true\n      point: [[0, 1, 1, 1], [1, 1, 1, 1]]\n",
      "a.yaml:5: world.obstacles[0].point: unknown key");
}

TEST(ScenarioFile, RefusesMoreCornersAndClassesThanItTakesTimeFor) {
  std::string corners =
      "semantics:\n  regions:\n    - name: r\n      class: meadow\n      prism:\n        z_min: 0\n        z_max: 1\n  "
      "      corners: [";
  for (int k = 0; k < 60'000; ++k) corners += "[" + std::to_string(k) + ", 0], ";
  EXPECT_EQ(error_of(corners + "[0, 1]]\n"),
            "a.yaml:8: semantics.regions[0].prism.corners: 60001 of them (limit 1000)");
  for (const std::string key : {"classes", "lambdas"}) {
    std::string classes = "semantics:\n  " + key + ":\n";
    for (int k = 0; k < 60'000; ++k) classes += "    c" + std::to_string(k) + ": free\n";
    EXPECT_EQ(error_of(classes), "a.yaml:60002: semantics." + key + ".c59999: 60000 classes (limit 255)");
  }
}

TEST(ScenarioFile, TakesLimitsAsOneNumberOrThreeAndInfiniteJerk) {
  const Scenario s = read("uav: {limits: {v_max: 3.5, a_max: [20, 20, 9.6], j_max: inf}}\n");
  EXPECT_EQ(s.uav.limits.v_max, Vec3(3.5, 3.5, 3.5));
  EXPECT_EQ(s.uav.limits.a_max, Vec3(20, 20, 9.6));
  EXPECT_EQ(s.uav.limits.j_max, Vec3::Constant(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(error_of("uav:\n  limits:\n    v_max: -3\n"),
            "a.yaml:3: uav.limits.v_max: -3 is out of range [0.001, 1000]");
  EXPECT_EQ(error_of("uav:\n  limits:\n    v_max: inf\n"),
            "a.yaml:3: uav.limits.v_max: inf is out of range [0.001, 1000]");
  EXPECT_EQ(error_of("uav:\n  limits:\n    a_max: [1, 0, 1]\n"),
            "a.yaml:3: uav.limits.a_max[1]: 0 is out of range [0.001, 10000]");
  EXPECT_EQ(error_of("uav:\n  limits:\n    j_max: 0\n"), "a.yaml:3: uav.limits.j_max: 0 is out of range [0.001, inf]");
}

TEST(ScenarioFile, TakesAMultirotorsDynamicsInPartAndNoneAreNone) {
  EXPECT_FALSE(read("uav: {}\n").uav.limits.dynamics);
  const auto dynamics = read("uav: {dynamics: {thrust_max: 39.2, tilt_max: 70}}\n").uav.limits.dynamics;
  ASSERT_TRUE(dynamics);
  EXPECT_EQ(dynamics->thrust_max, 39.2);
  EXPECT_EQ(dynamics->tilt_max_deg, 70.0);
  EXPECT_EQ(dynamics->body_rate_max_deg_s, Dynamics{}.body_rate_max_deg_s);
  EXPECT_EQ(error_of("uav:\n  dynamics:\n    thrust_max: 9\n"),
            "a.yaml:3: uav.dynamics.thrust_max: 9 is out of range [10.5, 10000]");
  EXPECT_EQ(error_of("uav:\n  dynamics:\n    tilt_max: 90\n"),
            "a.yaml:3: uav.dynamics.tilt_max: 90 is out of range [1, 85]");
}

TEST(ScenarioFile, ABoxBodyIsItsCorners) {
  const Scenario s = read("uav: {body: {half_extents: [0.1, 0.2, 0.3]}}\n");
  EXPECT_EQ(s.uav.body.radius, 0.0);
  EXPECT_EQ(s.uav.body.vertices.cols(), 8);
  EXPECT_EQ(s.uav.body.half_extents(), Vec3(0.1, 0.2, 0.3));
}

TEST(ScenarioFile, RefusesTwoBodies) {
  EXPECT_EQ(error_of("uav:\n  body:\n    radius: 0.1\n    vertices: [[0, 0, 1]]\n"),
            "a.yaml:3: uav.body.radius: give one of radius, half_extents, vertices");
  EXPECT_EQ(error_of("uav:\n  body:\n    vertices: []\n"), "a.yaml:3: uav.body.vertices: 0 vertices (limit 1 to 64)");
}

TEST(ScenarioFile, TheWholeBodyMustStartAndEndInsideTheFlightBox) {
  const std::string box = "  flight_box: {min: [-1, -1, 0], max: [9, 1, 4]}\n  body: {radius: 0.5}\n";
  EXPECT_EQ(error_of("uav:\n  start: [0, 0, 0.5]\n  goal: [8.5, 0, 1]\n" + box), "");
  EXPECT_EQ(error_of("uav:\n  start: [0, 0, 0.4]\n  goal: [8, 0, 1]\n" + box),
            "a.yaml:2: uav.start: [0, 0, 0.4] is outside the flight box, body included (limits [-0.5, -0.5, 0.5] to "
            "[8.5, 0.5, "
            "3.5])");
  EXPECT_EQ(
      error_of("uav:\n  start: [0, 0, 1]\n  goal: [9, 0, 1]\n" + box),
      "a.yaml:3: uav.goal: [9, 0, 1] is outside the flight box, body included (limits [-0.5, -0.5, 0.5] to [8.5, 0.5, "
      "3.5])");
  EXPECT_THAT(error_of("uav:\n  start: [0, 0, 1]\n" + box),
              ::testing::HasSubstr("uav.goal: [75, -1, 1], its default, is"));
  EXPECT_EQ(error_of("uav:\n  flight_box:\n    min: [0, 0, 0]\n    max: [1, 0, 1]\n"),
            "a.yaml:4: uav.flight_box.max: must be greater than min on every axis");
}

TEST(ScenarioFile, WhatHangsBelowNeedsNoRoomAbove) {
  const std::string load =
      "  flight_box: {min: [-1, -1, 0], max: [9, 1, 4]}\n  body: {vertices: [[0, 0, 0.1], [0, 0, -1]]}\n";
  EXPECT_EQ(error_of("uav:\n  start: [0, 0, 3.9]\n  goal: [8, 0, 1]\n" + load), "");
  EXPECT_EQ(error_of("uav:\n  start: [0, 0, 3.95]\n  goal: [8, 0, 1]\n" + load),
            "a.yaml:2: uav.start: [0, 0, 3.95] is outside the flight box, body included (limits [-1, -1, 1] to [9, 1, "
            "3.9])");
  EXPECT_EQ(error_of("uav:\n  start: [0, 0, 2]\n  goal: [8, 0, 0.9]\n" + load),
            "a.yaml:3: uav.goal: [8, 0, 0.9] is outside the flight box, body included (limits [-1, -1, 1] to [9, 1, "
            "3.9])");
}

TEST(ScenarioFile, OfSeveralRoutesTheSeedDrawsOneAndTheWay) {
  const std::string routes =
      "uav:\n  routes:\n    - {from: [0, 0, 1], to: [9, 0, 1]}\n    - {from: [0, 2, 1], to: [9, 2, 1]}\n";
  std::map<std::pair<double, double>, int> drawn;
  for (int seed = 1; seed <= 200; ++seed) {
    const Scenario scenario = read(fmt::format("seed: {}\n{}", seed, routes));
    EXPECT_EQ(scenario.uav.start.y(), scenario.uav.goal.y());
    EXPECT_EQ(scenario.uav.start.x() + scenario.uav.goal.x(), 9.0);
    ++drawn[{scenario.uav.start.x(), scenario.uav.start.y()}];
    EXPECT_EQ(read(write_scenario(scenario)).uav.start, scenario.uav.start)
        << "written out, the route is the drawn one";
  }
  ASSERT_EQ(drawn.size(), 4U);
  for (const auto& [start, times] : drawn) EXPECT_GT(times, 30);
}

TEST(ScenarioFile, RefusesRoutesBesideAStartAndOutsideTheFlightBox) {
  EXPECT_EQ(error_of("uav:\n  routes: [{from: [0, 0, 1], to: [9, 0, 1]}]\n  goal: [9, 0, 1]\n"),
            "a.yaml:2: uav.routes: cannot be combined with uav.start or uav.goal: each route has both");
  EXPECT_EQ(error_of("uav:\n  routes: [{from: [0, 0, 1]}]\n"), "a.yaml:2: uav.routes[0].to: is missing");
  for (int seed = 1; seed <= 8; ++seed) {
    EXPECT_THAT(error_of(fmt::format("seed: {}\nuav:\n  routes:\n    - {{from: [0, 0, 1], to: [8, 0, 1]}}\n"
                                     "    - {{from: [0, 0, 1], to: [9, 0, 1]}}\n"
                                     "  flight_box: {{min: [-1, -1, 0], max: [9, 1, 4]}}\n",
                                     seed)),
                testing::HasSubstr("[9, 0, 1] is outside the flight box"))
        << "whichever is drawn";
  }
}

TEST(ScenarioFile, OfARecordingReadsTheKeysOfItsUseOnly) {
  const std::string file = "world:\n  recorded:\n    - file: a.txt\n      ";
  EXPECT_EQ(error_of(file + "start_s: 3\n      wait_for_clear_start: false\n"), "");
  EXPECT_EQ(error_of(file + "copies: 3\n      within: {min: [0, 0, 0], max: [1, 1, 1]}\n"), "");
  EXPECT_EQ(error_of(file + "copies: 3\n"),
            "a.yaml:4: world.recorded[0].copies: needs `within`, the box in which they are");
  EXPECT_THAT(error_of(file + "within: {min: [0, 0, 0], max: [1, 1, 1]}\n"), testing::HasSubstr("unknown key"));
}

TEST(ScenarioFile, RefusesUnknownGeneratorsAndCountsWithoutOne) {
  EXPECT_EQ(error_of("world:\n  generator: corridor\n"),
            "a.yaml:2: world.generator: corridor is not one of none, paper_corridor, paper_attract, paper_repel, "
            "corridor_demo, "
            "mader_corridor, sando_forest, step_aside, blind_corner");
  EXPECT_EQ(error_of("world:\n  count: 3\n"), "a.yaml:2: world.count: 3 needs world.generator, which is none");
  EXPECT_EQ(error_of("world:\n  generator: sando_forest\n  count: 100001\n"),
            "a.yaml:3: world.count: 100001 is out of range [0, 100000]");
}

TEST(ScenarioFile, RefusesTheKeysOfAnotherMotion) {
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      phase: 1\n"),
            "a.yaml:4: world.obstacles[0].phase: unknown key (known here: centre, half_extents, motion, name)");
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      motion: trefoil\n      velocity: [1, 0, 0]\n"),
            "a.yaml:5: world.obstacles[0].velocity: unknown key (known here: centre, half_extents, motion, name, "
            "phase, scale, "
            "slowness)");
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      motion: waypoints\n      points: [[0, 1, 1, 1]]\n"),
            "a.yaml:3: world.obstacles[0].centre: is not used by motion waypoints");
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      motion: circle\n"),
            "a.yaml:4: world.obstacles[0].motion: circle is not one of static, trefoil, wave, linear, waypoints");
}

TEST(ScenarioFile, RefusesObstaclesThatLackWhatTheirMotionNeeds) {
  EXPECT_EQ(obstacle_error("name: a\n"), "a.yaml:3: world.obstacles[0].centre: is missing");
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      motion: linear\n"),
            "a.yaml:3: world.obstacles[0].velocity: is missing");
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      motion: wave\n"),
            "a.yaml:3: world.obstacles[0].amplitude: is missing");
  EXPECT_EQ(obstacle_error("motion: waypoints\n"), "a.yaml:3: world.obstacles[0].points: has no point (at least 1)");
  EXPECT_EQ(obstacle_error("centre: [0, 0, 0]\n      half_extents: [1, 0, 1]\n"),
            "a.yaml:4: world.obstacles[0].half_extents[1]: 0 is out of range (0, 10000]");
}

TEST(ScenarioFile, RefusesWaypointsOutOfOrderAndHalfRepeats) {
  const std::string head = "motion: waypoints\n      ";
  EXPECT_EQ(obstacle_error(head + "points: [[0, 0, 0, 0], [1, 0, 0, 0], [1, 2, 0, 0]]\n"),
            "a.yaml:4: world.obstacles[0].points: time 1 of point 2 is not after 1");
  EXPECT_EQ(obstacle_error(head + "points: [[0, 0, 0, 0]]\n      repeat: true\n"),
            "a.yaml:5: world.obstacles[0].repeat: true needs at least 2 points");
  EXPECT_EQ(obstacle_error(head + "points: [[0, 0, 0, 0], [1, 1, 0, 0]]\n      repeat: true\n"),
            "a.yaml:5: world.obstacles[0].repeat: true requires that the last point equals the first one");
  EXPECT_EQ(obstacle_error(head + "points: [[0, 0, 0, 0], [1, 0, 0, 0]]\n      repeat: true\n      vanish: true\n"),
            "a.yaml:6: world.obstacles[0].vanish: true cannot be combined with repeat: true");
}

TEST(ScenarioFile, RefusesNamesGivenTwice) {
  EXPECT_EQ(
      obstacle_error(
          "{name: a, centre: [0, 0, 0]}\n    - {name: b, centre: [0, 0, 0]}\n    - {name: a, centre: [1, 0, 0]}\n"),
      "a.yaml:5: world.obstacles[2].name: a is also the name of another entry");
  EXPECT_EQ(obstacle_error("{centre: [0, 0, 0]}\n    - {centre: [0, 0, 0]}\n"), "") << "obstacles need no name";
  EXPECT_EQ(region_error("{name: a, class: water, ball: {centre: [0, 0, 0], radius: 1}}\n"
                         "    - {name: a, class: water, ball: {centre: [0, 0, 0], radius: 1}}\n"),
            "a.yaml:4: semantics.regions[1].name: a is also the name of another entry");
}

TEST(ScenarioFile, RefusesNamesThatDoNotFitTheirMessages) {
  EXPECT_EQ(error_of("name: " + std::string(65, 'x')), "a.yaml:1: name: has 65 bytes (limit 64)");
  EXPECT_EQ(error_of("name: \"a\\nb\""), "a.yaml:1: name: has a control character");
  EXPECT_EQ(error_of("semantics:\n  classes:\n    " + std::string(33, 'x') + ": free\n"),
            "a.yaml:3: semantics.classes." + std::string(33, 'x') + ": has 33 bytes (limit 32)");
}

TEST(ScenarioFile, RefusesRecordedColumnsBeyondTheLineOrUsedTwice) {
  const auto recorded = [](const std::string& lines) {
    return error_of("world:\n  recorded:\n    - file: x.txt\n" + lines);
  };
  EXPECT_EQ(recorded(""), "");
  EXPECT_EQ(recorded("      columns: 4\n      y_column: 4\n"),
            "a.yaml:5: world.recorded[0].y_column: 4 is out of range [0, 3]");
  EXPECT_EQ(recorded("      z_column: 2\n"),
            "a.yaml:4: world.recorded[0].z_column: column 2 is another key's column too");
  EXPECT_EQ(recorded("      id_column: -1\n      z_column: -1\n"), "") << "two that were not recorded";
  EXPECT_EQ(error_of("world:\n  recorded:\n    - columns: 5\n"), "a.yaml:3: world.recorded[0].file: is missing");
}

TEST(ScenarioFile, RefusesRegionsWithoutExactlyOneShape) {
  EXPECT_EQ(region_error("name: a\n      class: water\n"),
            "a.yaml:3: semantics.regions[0].name: 0 shapes (give one of box, ball, prism)");
  EXPECT_EQ(region_error("name: a\n      class: water\n      ball: {centre: [0, 0, 0], radius: 1}\n      box: {}\n"),
            "a.yaml:3: semantics.regions[0].name: 2 shapes (give one of box, ball, prism)");
}

TEST(ScenarioFile, RefusesRegionsOfAClassThatHasNoLabel) {
  EXPECT_EQ(region_error("name: a\n      class: grass\n      ball: {centre: [0, 0, 0], radius: 1}\n"),
            "a.yaml:4: semantics.regions[0].class: grass is not one of semantics.classes");
  EXPECT_EQ(error_of("semantics:\n  lambdas:\n    wather: 3\n"),
            "a.yaml:3: semantics.lambdas.wather: is not one of semantics.classes");
  EXPECT_EQ(error_of("semantics:\n  lambdas:\n    water: -3\n"),
            "a.yaml:3: semantics.lambdas.water: -3 is out of range [0, 1000000]");
  EXPECT_EQ(error_of("semantics:\n  classes:\n    water: wet\n"),
            "a.yaml:3: semantics.classes.water: wet is not one of unknown, free, occupied, attractive, repulsive");
}

TEST(ScenarioFile, RefusesPrismsThatAreNoSolid) {
  const auto prism = [](const std::string& corners, const std::string& z) {
    return region_error("name: a\n      class: water\n      prism:\n        corners: " + corners + "\n" + z);
  };
  const std::string z = "        z_min: 0\n        z_max: 1\n";
  EXPECT_EQ(prism("[[0, 0], [1, 0], [0, 1]]", z), "");
  EXPECT_EQ(prism("[[0, 0], [1, 0]]", z), "a.yaml:6: semantics.regions[0].prism.corners: 2 corners (at least 3)");
  EXPECT_EQ(prism("[[0, 0], [1, 1], [1, 0], [0, 1]]", z),
            "a.yaml:6: semantics.regions[0].prism.corners: the polygon touches or crosses itself");
  EXPECT_EQ(prism("[[0, 0], [1, 0], [0, 1]]", "        z_min: 1\n        z_max: 1\n"),
            "a.yaml:8: semantics.regions[0].prism.z_max: must be greater than z_min");
}

TEST(ScenarioFile, RefusesSeedsAndTimeoutsOutOfRange) {
  EXPECT_EQ(error_of("seed: -1\n"), "a.yaml:1: seed: -1 is out of range [0, 9223372036854775807]");
  EXPECT_EQ(error_of("timeout_s: 0\n"), "a.yaml:1: timeout_s: 0 is out of range (0, 1000000]");
}

}  // namespace
}  // namespace tern
