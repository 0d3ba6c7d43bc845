#include <memory>

#include "mavlink/sim/app/autopilot_sim_node.h"
#include "runtime/command_line.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  using namespace tern::mavlink;
  std::string url;
  const tern::ProcessDescription description{
      .name = "tern-autopilot-sim",
      .section = "autopilot_sim",
      .summary = "A simulated quadrotor with an autopilot behind MAVLink, which behaves like PX4 or ArduPilot",
      .add_options =
          [&](tern::CommandLine& app) {
            app.add_option("--connect", url, "udpout://ADDRESS:PORT of the bridge, or another link");
          },
      .read_section = [](tern::ConfigSection section) { section.read<SimulatedAutopilotConfig>(); }};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    auto config = context.section.read<SimulatedAutopilotConfig>();
    tern::ConfigSection simulator = context.document.root().section("simulator");
    simulator.section("quadrotor").read(config.quadrotor);
    simulator.section("wind").read(config.wind);
    simulator.section("estimator").read(config.estimator);
    if (url.empty()) throw tern::ConfigError("--connect URL is required");
    auto link = tern::value_or_throw(open_link(url), "--connect ");
    return std::make_unique<AutopilotSimNode>(context.bus, std::move(link), config, context.scenario.seed);
  });
}
