#include <memory>

#include "executor/app/executor_config.h"
#include "executor/app/executor_node.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-executor",
      .section = "executor",
      .summary = "Asks for plans, adopts what may be flown, and publishes the vehicle's setpoints",
      .read_sections = [](tern::ConfigDocument& document) {
        tern::read_executor_config(document.root().section("executor"));
      }};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const auto config = tern::read_executor_config(context.section);
    return std::make_unique<tern::ExecutorNode>(context.bus, context.scenario.uav, config);
  });
}
