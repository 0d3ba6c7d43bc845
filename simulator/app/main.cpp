#include <memory>
#include <utility>

#include "runtime/command_line.h"
#include "runtime/log.h"
#include "runtime/process.h"
#include "simulator/app/make_vehicle.h"
#include "simulator/app/simulator_config.h"
#include "simulator/app/simulator_node.h"

int main(int argc, char** argv) {
  bool recorded = false;
  const tern::ProcessDescription description{
      .name = "tern-simulator",
      .section = "simulator",
      .summary =
          "Simulates the world, the sensors and the vehicle of a scenario, and judges the flight (FLIGHT_RESULT)",
      .add_options =
          [&recorded](tern::CommandLine& app) {
            app.add_flag("--recorded", recorded,
                         "Also wait for tern-logger, so that its log holds everything that a replay needs");
          },
      .read_section = [](tern::ConfigSection section) { tern::read_simulator_config(std::move(section), 0); },
      .example =
          "simulator: {sensor: {mode: noisy}, sensors: [{type: camera}], vehicle: quadrotor, estimation: vio, "
          "vio: {tags: [{position: [1, 0, 1]}], dark: [{from_s: 1}]}}"};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const tern::Scenario& scenario = context.scenario;
    auto config = tern::read_simulator_config(context.section, scenario.seed);
    if (recorded) config.wait_for.emplace_back(tern::kRecorder);
    auto world = tern::flyable_world_of(scenario, config);
    for (const std::string& remark : world.remarks) tern::log::warn("{}", remark);
    auto vehicle = tern::make_vehicle(scenario, config, context.bus.clock().now());
    return std::make_unique<tern::SimulatorNode>(context.bus, scenario, std::move(world), std::move(vehicle), config);
  });
}
