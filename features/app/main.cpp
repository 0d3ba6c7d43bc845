#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <utility>

#include "features/app/features_node.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // the node says what is wrong
  cv::setNumThreads(1);                                                   // the other cores are the planner's
  const tern::ProcessDescription description{
      .name = "tern-features",
      .section = "features",
      .summary = "Tracks features in the images of a stereo pair, recorded or live; publishes FEATURE_TRACKS",
      .read_section = [](tern::ConfigSection section) { tern::read_features_config(std::move(section)); }};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    return std::make_unique<tern::FeaturesNode>(context.bus, tern::read_features_config(context.section));
  });
}
