#include <cstdlib>
#include <memory>

#include "ros2/app/ros2_node.h"
#include "runtime/command_line.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  tern::ros2::Ros2Options options;
  std::string domain, goal_height;
  const tern::ProcessDescription description{
      .name = "tern-ros2",
      .section = "",
      .summary = "Passes messages between Tern and ROS 2, over DDS (docs/howto/ros2.md)",
      .add_options = [&](tern::CommandLine& app) {
        app.add_option("--domain", domain, "ROS_DOMAIN_ID, 0 to 232 (default: that of the environment, or 0)");
        app.add_option("--interface", options.network,
                       "Network interface for DDS, a name or an address; `any`: DDS's own choice, CYCLONEDDS_URI "
                       "(default: this host only)");
        app.add_option("--namespace", options.name_space, "Stands before all topics but /tf and /clock: /drone1");
        app.add_option("--remap", options.remaps, "TOPIC:=/NAME: the whole name of a topic (repeatable)")
            .allow_extra_args(false)
            .take_all();
        app.add_option("--send", options.send, "Topics that are sent, separated by commas; `all` (default) or `none`");
        app.add_option("--receive", options.receive,
                       "Topics that act on the flight, separated by commas: goal_pose, odom, following, detections, "
                       "cloud, octomap_binary (default: none)");
        app.add_option(
               "--goal-height", goal_height,
               "Height of a goal: `pose` (the z of the message), or `keep` (the vehicle's present height: for RViz, "
               "which sends 0)")
            .one_of({"pose", "keep"});
        app.add_option("--detection-sigma", options.in.detection_sigma_m,
                       "Standard deviation of detections without covariance, m (default 0.1)")
            .positive();
        app.add_option("--detection-range", options.in.detection_range_m,
                       "Range of the detector, m (default 0: no limit)")
            .range(0.0, 1e6);
        app.add_option("--cloud-range", options.in.cloud_range_m, "Range of the lidar, m (default 0: no limit)")
            .range(0.0, 1e6);
        app.add_option("--cloud-sensor", options.in.cloud_sensor,
                       "The frame whose origin is the lidar (default: the cloud's frame; for one in map, the vehicle)");
      }};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const char* given = std::getenv("ROS_DOMAIN_ID");
    options.domain = tern::ros2::domain_of(!domain.empty() ? domain : given != nullptr && *given != '\0' ? given : "0");
    options.in.keep_height = goal_height == "keep";
    return std::make_unique<tern::ros2::Ros2Node>(context.bus, context.scenario.uav, options);
  });
}
