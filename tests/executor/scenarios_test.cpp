// The scenario files of the repository, and the simulator's and the executor's sections.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "executor/executor.h"
#include "runtime/data_folder.h"
#include "runtime/scenario_file.h"
#include "simulator/app/simulator_config.h"
#include "simulator/worlds/world.h"

namespace tern {
namespace {

std::vector<std::string> scenario_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(TERN_SCENARIOS)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct ScenarioName {
  std::string operator()(const testing::TestParamInfo<std::string>& info) const {
    return std::filesystem::path(info.param).stem().string();
  }
};

class ScenarioFile : public testing::TestWithParam<std::string> {};

TEST_P(ScenarioFile, IsReadWholeAndHasAWorld) {
  ConfigDocument document = ConfigDocument::load(GetParam(), {});
  const Scenario scenario = read_scenario(document);
  EXPECT_EQ(scenario.name, std::filesystem::path(GetParam()).stem().string());
  EXPECT_NO_THROW((void)read_simulator_config(document.root().section("simulator"), scenario.seed));
  EXPECT_NO_THROW((void)document.root().section("executor").read<ExecutorConfig>());
  const std::string data = data_folder(GetParam(), std::getenv("TERN_DATA"));
  if (!scenario.world.recorded.empty() && data.empty()) return;
  const auto world = make_world(scenario, data);
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_GE(world->obstacles.size(), static_cast<std::size_t>(scenario.world.count));
}

INSTANTIATE_TEST_SUITE_P(Repository, ScenarioFile, testing::ValuesIn(scenario_files()), ScenarioName());

/// The bound of each world's flight, s.
TEST(ScenarioFiles, HaveTheBoundsOfTheBenchmarks) {
  const std::vector<std::pair<std::string, double>> bounds = {{"paper_corridor", 12.8},
                                                              {"mader_corridor", 15.25},
                                                              {"sando_forest", 21.45},
                                                              {"mader_corridor_own_limits", 22.11}};
  for (const auto& [name, bound] : bounds) {
    ConfigDocument document = ConfigDocument::load(std::string(TERN_SCENARIOS) + "/" + name + ".yaml", {});
    const UavSpec uav = read_scenario(document).uav;
    EXPECT_NEAR(rest_to_rest_bound_s(uav.start, uav.goal, uav.limits), bound, 0.006) << name;
  }
}

ConfigSection simulator_section(const std::string& yaml) {
  ConfigDocument document = ConfigDocument::parse("simulator:\n" + yaml, "test.yaml");
  return document.root().section("simulator");
}

TEST(SimulatorConfig, ReadsEveryKey) {
  const SimulatorConfig config = read_simulator_config(
      simulator_section(
          "  declare: false\n  wait_for: tern-planner tern-mapper\n  wait_s: 3\n  send_goal: false\n"
          "  min_flight_s: 4\n  sensor:\n    mode: noisy\n    range_m: 6\n    sigma_m: 0.1\n    rate_hz: 20\n"
          "    latency_s: 0.08\n    dropout: 0.2\n    ids: true\n"),
      9);
  EXPECT_FALSE(config.declare);
  EXPECT_THAT(config.wait_for, testing::ElementsAre("tern-planner", "tern-mapper"));
  EXPECT_EQ(config.wait.us, 3'000'000);
  EXPECT_FALSE(config.send_goal);
  EXPECT_EQ(config.min_flight_s, 4.0);
  EXPECT_EQ(config.sensor.range_m, 6.0);
  EXPECT_EQ(config.sensor.sigma_m, Vec3::Constant(0.1));
  EXPECT_EQ(config.sensor.rate_hz, 20.0);
  EXPECT_EQ(config.sensor.latency_s, 0.08);
  EXPECT_EQ(config.sensor.dropout, 0.2);
  EXPECT_TRUE(config.sensor.track_ids);
  EXPECT_EQ(config.sensor.seed, 9U);
}

TEST(SimulatorConfig, WaitsForNobodyWhenToldSo) {
  EXPECT_TRUE(read_simulator_config(simulator_section("  wait_for: none\n"), 1).wait_for.empty());
}

TEST(SimulatorConfig, RefusesWhatATruthfulSensorDoesNotHave) {
  EXPECT_THROW((void)read_simulator_config(simulator_section("  sensor:\n    sigma_m: 0.1\n"), 1), ConfigError);
  EXPECT_THROW((void)read_simulator_config(simulator_section("  sensor:\n    mode: blurred\n"), 1), ConfigError);
  EXPECT_THROW((void)read_simulator_config(simulator_section("  declares: true\n"), 1), ConfigError);
  EXPECT_THROW((void)read_simulator_config(simulator_section("  wait_s: -1\n"), 1), ConfigError);
}

TEST(ExecutorConfig, RefusesALeadWithoutRoomForAnAnswer) {
  ConfigDocument document = ConfigDocument::parse("executor:\n  lead_s: 0.005\n", "test.yaml");
  EXPECT_THROW((void)document.root().section("executor").read<ExecutorConfig>(), ConfigError);
}

}  // namespace
}  // namespace tern
