#include <memory>
#include <string>
#include <utility>

#include "mission/app/load_mission.h"
#include "mission/app/mission_node.h"
#include "runtime/command_line.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  using namespace tern::mission;
  std::string folder, url;
  const tern::ProcessDescription description{
      .name = "tern-mission",
      .section = "mission",
      .summary = "Flies the waypoints of a mission: publishes GOAL",
      .add_options =
          [&](tern::CommandLine& app) {
            app.add_option("--record", folder,
                           "Folder for mission.json and mission.txt: which steps were reached, when");
            app.add_option("--connect", url,
                           "Ground station that uploads missions over MAVLink: udpout://ADDRESS:PORT, or "
                           "serial:///dev/NAME:BAUD");
          },
      .read_section = [](tern::ConfigSection section) { read_mission_config(std::move(section)); }};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    const MissionConfig config = read_mission_config(context.section);
    MissionSetup setup;
    setup.site = site_of(context.scenario, config.progress);
    setup.uav = context.scenario.uav;
    setup.config = config.progress;
    setup.folder = folder;
    setup.system = config.system;
    setup.fence_uploads = config.fence_uploads;
    setup.start_on_upload = config.start_on_upload;
    if (!url.empty()) setup.link = tern::value_or_throw(tern::mavlink::open_link(url), "--connect ");
    if (url.empty() || !config.file.empty()) setup.mission = load_mission(context.scenario, config);
    return std::make_unique<MissionNode>(context.bus, std::move(setup));
  });
}
