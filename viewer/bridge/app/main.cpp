#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "runtime/process.h"
#include "viewer/bridge/app/export_node.h"

namespace {

/// A log is played on a bus that ends in this process: no network is needed, and none is disturbed.
std::vector<char*> arguments(int argc, char** argv) {
  static char url_option[] = "--lcm-url", url[] = "memq://";
  std::vector<char*> all(argv, argv + argc);
  const bool has_log = std::any_of(all.begin() + 1, all.end(), [](const std::string& argument) {
    const std::string name = argument.substr(0, argument.find('='));
    return name == "--log" || name == "--export" || name == "--video";
  });
  if (has_log) all.insert(all.end(), {url_option, url});
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  tern::ViewerOptions options;
  const tern::ProcessDescription description{
      .name = "tern-viewer",
      .section = "",
      .summary = "Shows a flight in the browser, live or from a log",
      .add_options = [&options](CLI::App& app) {
        app.add_option("--log,LOG", options.log, "Play this log instead of the live bus")->type_name("FILE");
        tern::add_export_options(app, options);
        app.add_option("--ghost", options.ghost, "Draw this log's flight over it")->type_name("FILE");
        app.add_option("--listen", options.listen,
                       "Where browsers are awaited; without a port, the first free one from 8765 (default 127.0.0.1)")
            ->type_name("ADDRESS[:PORT]");
        app.add_option("--page", options.page, "Folder of the built page")->type_name("DIR");
        app.add_flag("--allow-goals", options.allow_goals, "Pages may send goals");
        app.add_option("--allow-host", options.allow_hosts, "Another name by which browsers may call this host")
            ->type_name("NAME")
            ->allow_extra_args(false);
        app.add_option("--looked-fd", options.looked_fd, "Write a byte there when the first page looks");
        app.add_option("--url-file", options.url_file, "Write the page's URL there")->type_name("FILE");
      }};
  std::vector<char*> all = arguments(argc, argv);
  return tern::run_process(
      static_cast<int>(all.size()), all.data(), description,
      [&options](tern::ProcessContext& context) { return tern::make_viewer(context.bus, context.scenario, options); });
}
