#include <memory>

#include "executor/app/executor_node.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-executor",
      .section = "executor",
      .summary = "Requests plans, adopts those that may be flown, and publishes setpoints",
      .read_section = [](tern::ConfigSection section) { section.read<tern::ExecutorConfig>(); }};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const auto config = context.section.read<tern::ExecutorConfig>();
    return std::make_unique<tern::ExecutorNode>(context.bus, context.scenario.uav, config);
  });
}
