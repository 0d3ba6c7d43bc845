#include <memory>

#include "monitor/app/monitor_node.h"
#include "runtime/command_line.h"
#include "runtime/process.h"

int main(int argc, char** argv) {
  tern::MonitorOptions options;
  const tern::ProcessDescription description{
      .name = "tern-monitor",
      .section = "",
      .summary =
          "Shows a flight, judges its end and writes a summary. Exit code: 0 reached, 1 collision, 2 timeout, 3 "
          "failed, "
          "5 reached, but the recording is incomplete",
      .add_options = [&options](tern::CommandLine& app) {
        app.add_option("--summary", options.summary_file, "Write the summary as JSON")->type_name("FILE");
        app.add_option("--log", options.log, "Path of the recording, named in the summary")->type_name("FILE");
        app.add_option("--command", options.command, "Command line of the user, named in the summary")
            ->type_name("TEXT");
        app.add_option("--failure-file", options.failure_file,
                       "If this file appears, the flight has failed, and its text is the reason")
            ->type_name("FILE");
      }};
  return tern::run_process(argc, argv, description,
                           [&options](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
                             return tern::make_monitor(context, options);
                           });
}
