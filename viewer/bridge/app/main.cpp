
#include <string>

#include "runtime/command_line.h"
#include "runtime/process.h"
#include "viewer/bridge/app/export_node.h"

int main(int argc, char** argv) {
  tern::ViewerOptions options;
  std::string goal_height = "pose";
  const tern::ProcessDescription description{
      .name = "tern-viewer",
      .section = "",
      .summary = "Shows a flight in the browser, live or from a log",
      .add_options = [&](tern::CommandLine& app) {
        app.add_option("--log,LOG", options.log, "Play this log instead of a live flight")->type_name("FILE");
        tern::add_export_options(app, options);
        app.add_option("--ghost", options.ghost, "Draw the flight of another log over it")->type_name("FILE");
        app.add_option("--listen", options.listen,
                       "Address to listen on; without a port, the first free one from 8765 (default 127.0.0.1)")
            ->type_name("ADDRESS[:PORT]");
        app.add_option("--page", options.page, "Folder of the built page")->type_name("DIR");
        app.add_flag("--allow-goals", options.allow_goals, "Pages may send goals");
        app.add_option("--allow-host", options.allow_hosts, "Another name by which browsers may address this host")
            ->type_name("NAME")
            ->allow_extra_args(false);
        app.add_option("--foxglove", options.foxglove,
                       "Serve Foxglove at this port; without an address, on 127.0.0.1. Goals need --allow-goals")
            ->type_name("[ADDRESS:]PORT");
        app.add_option("--goal-height", goal_height,
                       "Height of Foxglove's goals: `pose`, or `keep`: the vehicle's (the 3D panel sends 0)")
            ->one_of({"pose", "keep"})
            .needs("--foxglove");
        app.add_option("--allow-origin", options.allow_origins,
                       "A web page that may connect to --foxglove: https://app.foxglove.dev")
            ->type_name("ORIGIN")
            ->allow_extra_args(false)
            ->needs("--foxglove");
        app.add_option("--looked-fd", options.looked_fd,
                       "Write a byte to this descriptor when the first page connects");
        app.add_option("--url-file", options.url_file, "Write the page's URL to this file")->type_name("FILE");
        tern::keep_logs_apart(app, options);
      }};
  return tern::run_process(argc, argv, description, [&](tern::ProcessContext& context) {
    options.keep_height = goal_height == "keep";
    return tern::make_viewer(context.bus, context.scenario, options);
  });
}
