#include <memory>

#include "detector/app/detector_node.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-detector",
      .section = "detector",
      .summary = "Finds obstacles in DEPTH_IMAGE and POINT_CLOUD; publishes OBSTACLE_SIGHTINGS",
      .read_section = [](tern::ConfigSection section) { section.read<tern::DetectorConfig>(); }};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    return std::make_unique<tern::DetectorNode>(context.bus, context.section.read<tern::DetectorConfig>());
  });
}
