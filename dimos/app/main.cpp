#include <fmt/format.h>

#include <memory>

#include "dimos/app/dimos_node.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  using namespace tern::dimos;
  DimosOptions options;
  const tern::ProcessDescription description{
      .name = "tern-dimos",
      .section = "dimos",
      .summary = "Passes messages between Tern and DimOS, as one of its native modules (docs/howto/drone_dimos.md)",
      .add_options =
          [&](tern::CommandLine& app) {
            for (const Port& port : ports()) {
              const std::string example = fmt::format("/TOPIC#{}", fmt::join(port.types, " or /TOPIC#"));
              app.add_option("--" + port.name, options.channels[port.name], "Channel of DimOS: " + example);
            }
            app.add_option("--dimos_url", options.url, fmt::format("DimOS's LCM network (default: {})", options.url));
            app.add_option("--world_frame", options.world_frame, "DimOS's name of its world (default: world)");
            app.add_option("--cloud_sensor", options.cloud_sensor,
                           "The frame whose origin is the lidar (default: the cloud's frame; for one in the world, the "
                           "vehicle)");
          },
      .read_section = [](tern::ConfigSection section) { section.read<DimosConfig>(); }};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    std::erase_if(options.channels, [](const auto& entry) { return entry.second.empty(); });
    return std::make_unique<DimosNode>(context.bus, context.scenario.uav, context.section.read<DimosConfig>(), options);
  });
}
