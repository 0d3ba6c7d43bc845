// tern-export: a recorded flight for other programs.
#include <fmt/format.h>

#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/tool.h"
#include "runtime/version.h"
#include "tools/export/export_log.h"

int main(int argc, char** argv) {
  tern::CommandLine app{
      "Exports a recorded flight for other programs. Exit code: 0 written, 2 bad arguments or log, or unwritable "
      "file."};
  app.set_version_flag("--version", fmt::format("tern-export {}", tern::build_id()));
  tern::exporting::ExportOptions options;
  app.add_option("LOG", options.log, "The log: a file (further parts are found), or a flight's folder")->required();
  app.add_option("--csv", options.csv_folder,
                 "Write CSV tables to this folder: one per channel, and one per list in its messages")
      ->type_name("DIR");
  app.add_option("--mcap", options.mcap_file, "Write an MCAP file, as Foxglove and Rerun open it")->type_name("FILE");
  app.add_option("--bag", options.bag_folder, "Write the MCAP file into a folder that `ros2 bag` plays")
      ->type_name("DIR")
      ->excludes(app.option("--mcap"));
  app.add_option("--channel-suffix", options.suffix, "Suffix of the vehicle's channels")->type_name("S");
  return tern::run_tool(app, "tern-export", argc, argv, [&] {
    fmt::print("{}", tern::value_or_throw(tern::exporting::export_log(options)));
    return 0;
  });
}
