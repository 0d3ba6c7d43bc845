#include <memory>

#include "predictor/app/predictor_config.h"
#include "predictor/app/predictor_node.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  const tern::ProcessDescription description{
      .name = "tern-predictor",
      .section = "predictor",
      .summary = "Predicts obstacles from detections and declared motions; publishes PREDICTIONS at 20 Hz",
      .read_section = tern::read_predictor_config};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    return std::make_unique<tern::PredictorNode>(context.bus, tern::read_predictor_config(context.section));
  });
}
