#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "launcher/app/flight.h"
#include "launcher/app/flight_options.h"
#include "launcher/app/supervisor.h"
#include "launcher/rules.h"
#include "runtime/version.h"

int main(int argc, char** argv) {
  CLI::App app("Starts processes, keeps them running, and ends them", "tern-launch");
  app.set_version_flag("--version", std::string("tern-launch ") + tern::build_id());
  app.require_subcommand(1);

  tern::FlightOptions options;
  std::string failed;
  CLI::App* const fly = app.add_subcommand("fly", "Fly a scenario; launch_scripts/fly.sh calls this");
  tern::declare_options(*fly, options);
  fly->add_option("--failed", failed,
                  "Do not fly: write the summary of a flight that could not begin, for this reason");

  std::string log;
  std::vector<std::string> command;
  CLI::App* const keep = app.add_subcommand("keep", "Run COMMAND, and run it again when it dies");
  keep->add_option("--log", log, "File for all that is said (default: standard output and error)");
  keep->add_option("COMMAND", command)->required();
  keep->prefix_command();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : *keep ? 2 : tern::kExitFailed;
  }
  try {
    if (*keep) return tern::keep_alive(command, log);
    if (failed.empty()) return tern::fly(options);
    tern::summarize_failure(options, failed);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tern-launch: %s\n", e.what());
    return tern::kExitFailed;
  }
}
