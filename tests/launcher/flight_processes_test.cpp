#include "launcher/flight_processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace tern {
namespace {

using Words = std::vector<std::string>;

LaunchOptions demo() {
  LaunchOptions options;
  options.programs = "bin";
  options.scenario = "demo.yaml";
  options.lcm_url = "udpm://";
  options.overrides = {"seed=2", "uav.goal=[1,2,3]"};
  return options;
}

Words names(const std::vector<SupervisedProcess>& processes) {
  Words names;
  for (const SupervisedProcess& p : processes) names.push_back(p.name);
  return names;
}

TEST(FlightProcesses, BeginWithTheViewerThenWhoRecordsAndWhoJudges) {
  LaunchOptions options = demo();
  EXPECT_EQ(names(flight_processes(options, "r", {})),
            (Words{"tern-logger", "tern-monitor", "tern-simulator", "tern-executor", "tern-predictor", "tern-mapper",
                   "tern-planner"}));
  options.view_fd = 7;
  EXPECT_EQ(names(flight_processes(options, "r", {}))[0], "tern-viewer");
}

TEST(FlightProcesses, HaveAnEstimatorIfTheScenarioAsksForIt) {
  LaunchOptions options = demo();
  options.estimates = true;
  EXPECT_EQ(names(flight_processes(options, "r", {})).back(), "tern-estimator");
  EXPECT_TRUE(flight_processes(options, "r", {}).back().restarted);
}

TEST(FlightProcesses, HaveADetectorIfTheScenarioHasItsSection) {
  LaunchOptions options = demo();
  options.detects = true;
  EXPECT_EQ(names(flight_processes(options, "r", {})).back(), "tern-detector");
}

TEST(FlightProcesses, WithAnAutopilotHaveABridge) {
  LaunchOptions options = demo();
  options.autopilot = "udp://127.0.0.1:14540";
  EXPECT_EQ(names(flight_processes(options, "r", {})).back(), "tern-mavlink");
  options.odometry = "udp://127.0.0.1:14560";
  EXPECT_EQ(flight_processes(options, "r", {}).back().child.command.back(), options.odometry);
  options.autopilot_sim = true;
  const auto processes = flight_processes(options, "r", {});
  EXPECT_EQ(processes.back().name, "tern-autopilot-sim");
  EXPECT_FALSE(processes.back().restarted);
  EXPECT_EQ(processes.back().child.command.back(), "udpout://127.0.0.1:14540");
  const Words& simulator = processes[2].child.command;
  const auto ours = std::find(simulator.begin(), simulator.end(), "simulator.vehicle=external");
  const auto users = std::find(simulator.begin(), simulator.end(), "seed=2");
  ASSERT_NE(ours, simulator.end());
  EXPECT_LT(ours, users) << "the user's values win";
}

TEST(FlightProcesses, KeepAnAutopilotWithinPx4sDefaultBoundsUnlessTheScenarioStatesItsVehicle) {
  Limits limits;
  limits.v_max = Vec3(6, 6, 6);
  EXPECT_EQ(autopilot_limits(limits, false),
            (Words{"uav.dynamics={thrust_min: 4, thrust_max: 16, tilt_max: 38, body_rate_max: 170}",
                   "uav.limits.v_max=[6, 6, 1.5]"}));
  limits.v_max = Vec3(30, 40, 1);
  EXPECT_EQ(autopilot_limits(limits, false)[1], "uav.limits.v_max=[7.199999999999999, 9.6, 1]");
  limits.dynamics.emplace();
  EXPECT_EQ(autopilot_limits(limits, false), Words());
}

TEST(FlightProcesses, KeepTheSpeedOfAStatedVehicleWithinTheBoundsOfASimulatedAutopilot) {
  Limits limits;
  limits.dynamics.emplace();
  limits.v_max = Vec3(2, 2, 2);
  EXPECT_EQ(autopilot_limits(limits, true), Words{"uav.limits.v_max=[2, 2, 1.5]"});
  limits.v_max = Vec3(2, 2, 1);
  EXPECT_EQ(autopilot_limits(limits, true), Words());
}

TEST(FlightProcesses, AreAllRestartedButTheMonitor) {
  for (const SupervisedProcess& p : flight_processes(demo(), "r", {})) {
    EXPECT_EQ(p.restarted, p.name != "tern-monitor") << p.name;
  }
}

TEST(FlightProcesses, TellTheSimulatorThatTheLoggerRecords) {
  for (const SupervisedProcess& p : flight_processes(demo(), "r", {})) {
    EXPECT_EQ(std::count(p.child.command.begin(), p.child.command.end(), "--recorded"), p.name == "tern-simulator");
  }
}

TEST(FlightProcesses, AllGetScenarioOverridesAndNetwork) {
  const Words common = {"--config",         "demo.yaml", "--set",   "seed=2", "--set",
                        "uav.goal=[1,2,3]", "--lcm-url", "udpm://", "--pace", "1"};
  for (const SupervisedProcess& p : flight_processes(demo(), "r", {})) {
    const Words& words = p.child.command;
    EXPECT_EQ(words.front(), "bin/" + p.name);
    ASSERT_GE(words.size(), common.size() + 1);
    EXPECT_TRUE(std::equal(common.begin(), common.end(), words.begin() + 1)) << shell_line(words);
  }
}

TEST(FlightProcesses, InheritTheirOwnKeysAndTheViewerTheSocket) {
  LaunchOptions options = demo();
  options.view_fd = 9;
  const std::map<std::string, int> keys = {{"tern-planner", 5}, {"tern-viewer", 6}};
  for (const SupervisedProcess& p : flight_processes(options, "r", keys)) {
    const bool has_key = keys.count(p.name) == 1;
    std::vector<int> expected;
    if (has_key) expected.push_back(keys.at(p.name));
    if (p.name == "tern-viewer") expected.push_back(9);
    EXPECT_EQ(p.child.inherited, expected) << p.name;
    EXPECT_EQ(std::count(p.child.command.begin(), p.child.command.end(), "--key-fd"), has_key ? 1 : 0) << p.name;
  }
}

TEST(FlightProcesses, WhoDoesNotFlyChecksItsSectionNevertheless) {
  LaunchOptions options = demo();
  Words sections = {"uav", "mavlink", "autopilot_sim"};
  const auto checked = [&] {
    Words programs;
    for (const Words& words : checks_of_unused_sections(options, flight_processes(options, "r", {}), sections)) {
      EXPECT_EQ(Words(words.begin() + 1, words.end()),
                (Words{"--check-config", "--config", "demo.yaml", "--set", "seed=2", "--set", "uav.goal=[1,2,3]"}));
      programs.push_back(words.front());
    }
    return programs;
  };
  EXPECT_EQ(checked(), (Words{"bin/tern-mavlink", "bin/tern-autopilot-sim"}));
  options.autopilot = "udp://127.0.0.1:14540";
  EXPECT_EQ(checked(), Words{"bin/tern-autopilot-sim"});
  options.autopilot_sim = true;
  EXPECT_EQ(checked(), Words{});
  options = demo();
  sections = {"uav", "mavlink"};
  EXPECT_EQ(checked(), Words{"bin/tern-mavlink"});
  sections = {"uav"};  // then the programs need not be there
  EXPECT_EQ(checked(), Words{});
}

TEST(FlightProcesses, AMissionSendsTheGoals) {
  LaunchOptions options = demo();
  options.mission = "/m/square.csv";
  const auto words_of = [&](const std::string& name) {
    for (const SupervisedProcess& p : flight_processes(options, "r", {})) {
      if (p.name == name) return p.child.command;
    }
    return Words{};
  };
  EXPECT_THAT(words_of("tern-simulator"), ::testing::IsSupersetOf({"simulator.goals_from=tern-mission"}));
  EXPECT_THAT(words_of("tern-mapper"), ::testing::IsSupersetOf({"mission.file=/m/square.csv"}));
  EXPECT_THAT(words_of("tern-mission"), ::testing::IsSupersetOf({"--record", "r"}));
  options.mission = "udpout://127.0.0.1:14550";
  EXPECT_THAT(words_of("tern-mission"), ::testing::IsSupersetOf({"--connect", "udpout://127.0.0.1:14550"}));
  EXPECT_THAT(words_of("tern-mapper"), ::testing::Contains("mission.fence_uploads=true"));
}

TEST(ShellLine, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(shell_line({"a", "b c", "it's", ""}), R"('a' 'b c' 'it'\''s' '')");
}

}  // namespace
}  // namespace tern
