#include <memory>

#include "estimator/app/estimator_node.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-estimator",
      .section = "estimator",
      .summary = "Estimates the vehicle's motion from IMU, FEATURE_TRACKS and POSITION_FIX; publishes ODOMETRY",
      .read_section = [](tern::ConfigSection section) { section.read<tern::EstimatorNodeConfig>(); }};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const auto config = context.section.read<tern::EstimatorNodeConfig>();
    return std::make_unique<tern::EstimatorNode>(context.bus, config, context.scenario.uav.start);
  });
}
