#include "launcher/app/flight_options.h"

#include <CLI/CLI.hpp>

namespace tern {

void declare_options(CLI::App& app, FlightOptions& options) {
  app.add_option("--programs", options.programs, "The folder of Tern's programs")->required();
  app.add_option("--config", options.scenario, "Scenario file")->required();
  app.add_option("--set", options.overrides, "As of every process")->allow_extra_args(false);
  app.option_defaults()->take_last();
  app.add_option("--lcm-url", options.lcm_url, "LCM network");
  app.add_option("--namespace", options.namespace_flags, "The flags of unshare that made its network namespace");
  app.add_option("--record", options.record, "The flight's folder (default: a new one in --flights)");
  app.add_option("--flights", options.flights, "The folder of records");
  app.add_option("--summary", options.summary, "Write the summary there, too");
  app.add_option("--typed", options.typed, "What the user typed, for the record");
  app.add_flag(
      "--new-key", [&](std::int64_t) { options.key = ""; }, "Sign every message, with a new key");
  app.add_option("--key-file", options.key, "Sign every message, with the master key of this file");
  app.add_option("--view-fd", options.view_fd, "A listening socket (tern-listen): tern-viewer shows the flight there");
  app.add_option("--view-url", options.view_url, "That socket's URL");
  app.add_option("--page", options.page, "The folder of tern-viewer's page");
  app.add_flag("--allow-goals", options.allow_goals, "The page may send goals");
  app.add_flag("--audit", options.audit, "Recompute the flight when it has ended");
  app.add_flag("--report", options.report, "Draw the flight when it has ended");
}

}  // namespace tern
