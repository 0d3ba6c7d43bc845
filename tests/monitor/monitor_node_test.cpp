#include "monitor/app/monitor_node.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/world/names.h"
#include "messages/codec.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "runtime/virtual_runner.h"

namespace tern {
namespace {

const Scenario kScenario;

std::string temp_file(const std::string& name) {
  const std::string path = testing::TempDir() + "/" + name + std::to_string(getpid());
  std::filesystem::remove(path);
  return path;
}

/// Runs a monitor in virtual time after `before` has had its way with the network.
template <class Before>
RunResult run_monitor(const MonitorOptions& options, Before&& before) {
  VirtualRunner runner;
  runner.start("tern-monitor", [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, kScenario, options); });
  before(runner.observer());
  return runner.run(runner.now() + Duration{60'000'000});
}

TEST(Monitor, ExitCodeAndSummaryAreTheRefereesOutcome) {
  for (const FlightOutcome outcome :
       {FlightOutcome::Reached, FlightOutcome::Collision, FlightOutcome::Timeout, FlightOutcome::Failed}) {
    MonitorOptions options;
    options.summary_file = temp_file("summary");
    const RunResult result = run_monitor(options, [&](Bus& bus) {
      Heartbeat simulator;
      simulator.process = kSimulatorProcess;
      simulator.state = ProcessState::Finished;
      bus.publish(channels::kHeartbeat, simulator);
      FlightResult verdict;
      verdict.outcome = outcome;
      bus.publish(channels::kFlightResult, verdict);
    });
    EXPECT_EQ(result.end, RunEnd::Finished);
    EXPECT_EQ(result.exit_code, static_cast<int>(outcome));
    std::ifstream file(options.summary_file);
    const auto summary = nlohmann::json::parse(file);
    EXPECT_EQ(summary["outcome"], to_string(outcome));
    EXPECT_EQ(summary["messages"]["FLIGHT_RESULT"]["received"], 1);
    std::filesystem::remove(options.summary_file);
  }
}

TEST(Monitor, RefusesASummaryThatCannotBeWrittenBeforeTheFlight) {
  MonitorOptions options;
  options.summary_file = temp_file("no_such_folder") + "/summary.json";
  VirtualRunner runner;
  EXPECT_THROW(
      runner.start("tern-monitor", [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, kScenario, options); }),
      ConfigError);
  options.summary_file = temp_file("summary");
  runner.start("tern-monitor", [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, kScenario, options); });
  EXPECT_FALSE(std::filesystem::exists(options.summary_file)) << "to ask leaves no file behind";
}

TEST(Monitor, HoldsTheKeysOfAllThatItHears) {
  VirtualRunner runner;
  runner.use_key(random_key());
  const MonitorOptions options;
  EXPECT_NO_THROW(
      runner.start("tern-monitor", [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, kScenario, options); }));
}

TEST(Monitor, FailsWithoutASimulator) {
  const RunResult result = run_monitor({}, [](Bus&) {});
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_EQ(result.exit_code, 3);
}

TEST(Monitor, FailsWhenTheLauncherGivesUp) {
  MonitorOptions options;
  options.failure_file = temp_file("failure");
  std::ofstream(options.failure_file) << "tern-planner ended with exit code 2\n";
  VirtualRunner runner;
  runner.start("tern-monitor", [&](Bus& bus) { return std::make_unique<MonitorNode>(bus, kScenario, options); });
  const RunResult result = runner.run(runner.now() + Duration{1'000'000});
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_EQ(result.exit_code, 3);
  std::filesystem::remove(options.failure_file);
}

/// Returns how a monitor ends in ten minutes of a flight without a verdict.
RunEnd watch_ten_minutes(const std::string& yaml) {
  ConfigDocument document = ConfigDocument::parse(yaml, "test.yaml");
  const Scenario scenario = read_scenario(document);
  VirtualRunner runner;
  runner.start("tern-monitor", [&](Bus& bus) {
    ProcessContext context{scenario, document.root(), bus, document};
    return make_monitor(context, {});
  });
  HorizonRequest request;
  request.id = 1;
  request.t_s = request.committed.start = runner.now() + Duration{75'000};
  request.deadline = request.t_s - kDeadlineLead;
  request.committed.control_points = scenario.uav.start.replicate(1, 7);
  request.start = request.committed.sample(request.t_s);
  request.flight_box = scenario.uav.flight_box;
  runner.observer().publish(channels::kHorizonRequest, request);
  Heartbeat simulator;
  simulator.process = kSimulatorProcess;
  simulator.state = ProcessState::Ready;
  for (int s = 0; s < 600; ++s) {
    runner.observer().publish(channels::kHeartbeat, simulator);
    if (runner.run(runner.now() + Duration{1'000'000}).end == RunEnd::Finished) return RunEnd::Finished;
  }
  return RunEnd::Time;
}

TEST(Monitor, AMissionHasTheTimeLimitThatItsScenarioStatesOrNone) {
  EXPECT_EQ(watch_ten_minutes("simulator: {send_goal: true}"), RunEnd::Finished);
  EXPECT_EQ(watch_ten_minutes("simulator: {goals_from: tern-mission}"), RunEnd::Time);
  EXPECT_EQ(watch_ten_minutes("{timeout_s: 30, simulator: {goals_from: tern-mission}}"), RunEnd::Finished);
}

}  // namespace
}  // namespace tern
