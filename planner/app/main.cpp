// tern-planner: answers HORIZON_REQUEST with a certified PLAN.
#include <memory>
#include <utility>

#include "planner/app/config_reader.h"
#include "planner/app/planner_node.h"
#include "planner/problem/planner_config.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-planner",
      .section = "planner",
      .summary = "Plans collision-free trajectories and certifies each of them",
      .read_section = [](tern::ConfigSection section) { tern::read_planner_config(std::move(section), {}); }};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const tern::PlannerConfig config = tern::read_planner_config(context.section, context.scenario.semantics);
    const std::uint64_t hash = tern::configuration_hash(context.document.effective());
    return std::make_unique<tern::PlannerNode>(context.bus, context.scenario.uav, config, hash,
                                               tern::PlannerExecution{}, tern::named_places(context.scenario));
  });
}
