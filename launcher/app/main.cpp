#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "launcher/app/flight.h"
#include "launcher/app/supervisor.h"
#include "launcher/rules.h"
#include "runtime/command_line.h"
#include "runtime/version.h"

int main(int argc, char** argv) {
  tern::CommandLine app("Starts processes, restarts those that die, and ends them", "tern-launch");
  app.set_version_flag("--version", std::string("tern-launch ") + tern::build_id());
  app.require_subcommand(1, 1);
  tern::LaunchOptions options;
  std::string failed, log;
  std::vector<std::string> command;
  tern::CommandLine fly = app.add_subcommand("fly", "Fly a scenario; launch_scripts/fly.sh calls this");
  fly.add_option("--programs", options.programs, "Folder of Tern's programs")->required();
  fly.add_option("--config", options.scenario, "Scenario file")->required();
  fly.add_option("--set", options.overrides, "Override a value of the scenario file")->allow_extra_args(false);
  fly.take_last();
  fly.add_option("--lcm-url", options.lcm_url, "LCM network");
  fly.add_option("--pace", options.pace, "Pace of the flight")->envname("TERN_PACE")->range(0.01, 1.0);
  fly.add_option("--namespace", options.namespace_flags, "Flags of unshare(1) that made the network namespace");
  fly.add_option("--record", options.record, "Folder of the flight (default: a new one in --flights)");
  fly.add_option("--flights", options.flights, "Folder for new flights");
  fly.add_option("--summary", options.summary, "Also write the summary to this file");
  fly.add_option("--typed", options.command, "Command line of the user, for the record");
  fly.add_flag(
      "--new-key", [&] { options.key = ""; }, "Sign every message with a new key");
  fly.add_option("--key-file", options.key, "Sign every message with the master key of this file");
  fly.add_option("--view-fd", options.view_fd, "Listening socket (tern-listen) for tern-viewer");
  fly.add_option("--view-url", options.view_url, "URL of that socket");
  fly.add_option("--view-wait", options.view_wait_s, "Longest wait for the first page, s")->range(0, 86400);
  fly.add_option("--page", options.page, "Folder of tern-viewer's page");
  fly.add_flag("--allow-goals", options.allow_goals, "Pages may send goals");
  fly.add_option("--autopilot", options.autopilot, "Autopilot that flies the vehicle (tern-mavlink)");
  fly.add_option("--odometry", options.odometry, "Where another estimator sends MAVLink's ODOMETRY (tern-mavlink)");
  fly.add_flag("--autopilot-sim", options.autopilot_sim, "The autopilot is tern-autopilot-sim");
  fly.add_option("--mission", options.mission, "Mission that tern-mission flies: a file, or a ground station's URL");
  fly.add_flag("--audit", options.audit, "Run tern-audit after the flight");
  fly.add_flag("--report", options.report, "Run tern-report after the flight");
  fly.add_option("--failed", failed, "Do not fly; write a summary with this reason of failure");
  tern::CommandLine keep = app.add_subcommand("keep", "Run COMMAND, and restart it when it dies");
  keep.prefix_command();
  keep.add_option("--log", log, "File for its output (default: standard output and error)");
  keep.add_option("COMMAND", command, "Program and its arguments")->required();
  try {
    if (const auto code = app.parse(argc, argv, tern::kExitFailed)) return *code == 0 ? 0 : keep ? 2 : *code;
    if (keep) return tern::keep_alive(command, log);
    if (failed.empty()) return tern::fly(options);
    tern::summarize_failure(options, failed);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tern-launch: %s\n", e.what());
    return tern::kExitFailed;
  }
}
