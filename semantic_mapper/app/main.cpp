#include "runtime/process.h"
#include "semantic_mapper/app/mapper_config.h"
#include "semantic_mapper/app/mapper_node.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-mapper",
      .section = "mapper",
      .summary = "Labels voxels from regions and point clouds; publishes SEMANTIC_MAP",
      .read_section = [](tern::ConfigSection section) { tern::read_mapper_config(section); },
      .example = "mapper: {extents: {min: [0, 0, 0], max: [1, 1, 1]}, sources: [{file: town.las}]}"};
  return tern::run_process(argc, argv, description, tern::make_mapper_node);
}
