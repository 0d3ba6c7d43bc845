#include "benchmarks/flight_recording.h"

#include "campaign/virtual_system.h"
#include "messages/channels.h"
#include "planner/app/config_reader.h"
#include "planner/app/world_intake.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "simulator/app/simulator_node.h"

namespace tern {
namespace {

constexpr Duration kLongestFlight{600LL * 1'000'000};

}  // namespace

FlightRecording record_flight(const std::string& scenario_file, const std::vector<std::string>& overrides) {
  FlightRecording recording;
  ConfigDocument document = ConfigDocument::load(scenario_file, overrides);
  recording.scenario = read_scenario(document);
  recording.config = read_planner_config(document.root().section("planner"), recording.scenario.semantics);
  VirtualSystem system(scenario_file, overrides);
  VirtualRunner& runner = system.runner();
  Bus& bus = runner.observer();
  WorldIntake intake(bus, recording.config, recording.scenario.uav, false);
  bus.subscribe(channels::kHorizonRequest, [&](const HorizonRequest& request) {
    intake.set_vehicle(request);
    intake.prepare();
    recording.moments.push_back({request, intake.snapshot()});
  });
  const SimulatorNode& simulator = system.simulator();
  runner.run(runner.now() + kLongestFlight, [&] { return simulator.result().has_value(); });
  if (simulator.result()) recording.result = *simulator.result();
  return recording;
}

}  // namespace tern
