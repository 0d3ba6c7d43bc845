#include "campaign/virtual_flight.h"

#include <cstdlib>
#include <memory>
#include <utility>

#include "planner/app/config_reader.h"
#include "planner/app/planner_node.h"
#include "predictor/app/predictor_config.h"
#include "predictor/app/predictor_node.h"
#include "runtime/channels.h"
#include "runtime/config.h"
#include "runtime/data_folder.h"
#include "runtime/process.h"
#include "runtime/scenario_file.h"
#include "runtime/virtual_runner.h"
#include "semantic_mapper/app/load_map.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/app/mapper_node.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/simulator_node.h"

namespace tern {
namespace {

/// No flight of a scenario lasts longer, virtual time.
constexpr Duration kLongestFlight{3600LL * 1'000'000};

SimulatorNode& start_simulator(VirtualRunner& runner, ConfigDocument& document, const Scenario& scenario) {
  const SimulatorConfig config = read_simulator_config(document.root().section("simulator"), scenario.seed);
  const ExecutorConfig executor = read_executor_config(document.root().section("executor"));
  auto world = make_world(scenario, data_folder(scenario.file, std::getenv("TERN_DATA")));
  if (!world) throw ConfigError(scenario.file + ": world: " + world.error().message);
  return static_cast<SimulatorNode&>(runner.start("tern-simulator", [&](Bus& bus) {
    return std::make_unique<SimulatorNode>(bus, scenario, std::move(*world), config, executor);
  }));
}

void start_others(VirtualRunner& runner, ConfigDocument& document, const Scenario& scenario) {
  const PredictorConfig predictor = read_predictor_config(document.root().section("predictor"));
  runner.start("tern-predictor", [&](Bus& bus) { return std::make_unique<PredictorNode>(bus, predictor); });
  const MapperConfig mapper = read_mapper_config(document.root().section("mapper"));
  const VoxelMap map = load_map(scenario, mapper, std::getenv("TERN_DATA"));
  runner.start("tern-mapper", [&](Bus& bus) { return std::make_unique<MapperNode>(bus, map); });
  const PlannerConfig planner = read_planner_config(document.root().section("planner"), scenario.semantics);
  const std::uint64_t hash = configuration_hash(document.effective());
  PlannerExecution execution;
  execution.threaded = false;
  runner.start("tern-planner", [&](Bus& bus) {
    return std::make_unique<PlannerNode>(bus, scenario.uav, planner, hash, execution);
  });
}

}  // namespace

VirtualFlight fly_virtually(const std::string& scenario_file, const std::vector<std::string>& overrides,
                            FlightObserver* observer) {
  ConfigDocument document = ConfigDocument::load(scenario_file, overrides);
  const Scenario scenario = read_scenario(document);
  VirtualRunner runner;
  VirtualFlight flight;
  Bus& bus = runner.observer();
  bus.subscribe<Plan>(channels::kPlan, [&](const Plan& plan) {
    ++flight.outcomes[static_cast<std::size_t>(plan.outcome)];
    ++flight.reasons[static_cast<std::size_t>(plan.reason)];
    if (observer != nullptr) observer->on_plan(plan);
  });
  bus.subscribe<HorizonRequest>(channels::kHorizonRequest, [&](const HorizonRequest& request) {
    if (observer != nullptr) observer->on_request(request);
  });
  bus.subscribe<PlanTiming>(channels::kPlanTiming, [&](const PlanTiming& t) { flight.timings.push_back(t); });
  const SimulatorNode& simulator = start_simulator(runner, document, scenario);
  start_others(runner, document, scenario);
  const RunResult run = runner.run(runner.now() + kLongestFlight, [&] { return simulator.result().has_value(); });
  if (simulator.result()) flight.result = *simulator.result();
  if (run.end == RunEnd::Finished) flight.end = run.process + " ended with exit code " + std::to_string(run.exit_code);
  if (run.end == RunEnd::Time) flight.end = "no end within an hour";
  flight.executor = simulator.executor().counters();
  return flight;
}

}  // namespace tern
