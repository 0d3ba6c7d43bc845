#include "benchmarks/flight_recording.h"

#include <fmt/format.h>

#include <algorithm>

#include "campaign/virtual_system.h"
#include "core/base/percentiles.h"
#include "messages/channels.h"
#include "planner/app/config_reader.h"
#include "planner/app/world_intake.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "runtime/stopwatch.h"
#include "simulator/app/simulator_node.h"

namespace tern {
namespace {

constexpr Duration kMaxFlight{600LL * 1'000'000};

}  // namespace

FlightRecording record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides) {
  FlightRecording recording;
  ConfigDocument document = ConfigDocument::load(scenario_file, overrides);
  recording.scenario = read_scenario(document);
  recording.config = read_planner_config(document.root().section("planner"), recording.scenario.semantics);
  VirtualSystem system(scenario_file, overrides);
  VirtualRunner& runner = system.runner();
  Bus& bus = runner.observer();
  WorldIntake intake(bus, recording.config, recording.scenario.uav, false, {});
  bus.subscribe(channels::kHorizonRequest, [&](const HorizonRequest& request) {
    intake.set_vehicle(request);
    intake.prepare();
    recording.moments.push_back({request, intake.snapshot()});
  });
  const SimulatorNode& simulator = system.simulator();
  runner.run(runner.now() + kMaxFlight, [&] { return simulator.result().has_value(); });
  if (simulator.result()) recording.result = *simulator.result();
  return recording;
}

void FlightSelection::add_options(CommandLine& app) {
  app.add_option("--config", scenario, "Scenario file")->required();
  app.add_option("--set", overrides, "Override key=value (repeatable)");
  app.add_option("--first", first, "First seed");
  app.add_option("--last", last, "Last seed");
}

void FlightSelection::each(const std::function<void(std::int64_t, const FlightRecording&)>& use) const {
  for (std::int64_t seed = first; seed <= last; ++seed) {
    std::vector<std::string> with_seed = overrides;
    with_seed.push_back(fmt::format("seed={}", seed));
    use(seed, record_flight(scenario, with_seed));
  }
}

double cpu_ms_of(const std::function<void()>& work) {
  const double begin = thread_cpu_ms();
  work();
  return thread_cpu_ms() - begin;
}

double plan_ms(const Moment& moment, const PlannerConfig& config, PlanWorkspace& workspace) {
  Budget budget = Budget::unlimited();
  return cpu_ms_of([&] { plan(moment.request, moment.world, config, budget, workspace); });
}

std::string percentiles_text(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](std::size_t percent) { return percentile_of_sorted(values, percent); };
  return fmt::format("p50 {:.3f}  p90 {:.3f}  p99 {:.3f}  max {:.3f}", at(50), at(90), at(99), values.back());
}

}  // namespace tern
