// tern-replay: plans every answer of a log again and compares.
#include <fmt/format.h>

#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/tool.h"
#include "runtime/version.h"
#include "tools/replay/extract.h"
#include "tools/replay/replay_report.h"

int main(int argc, char** argv) {
  tern::CommandLine app{
      "Plans every answer of a log again from its recorded inputs and compares the bytes. Exit code: 0 equal, 1 "
      "different, 2 bad arguments or log, 3 inputs are missing in the log."};
  std::string log, json, save, dump;
  tern::ReplayOptions options;
  app.set_version_flag("--version", fmt::format("tern-replay {}", tern::build_id()));
  app.add_option("LOG", log, "Log of tern-logger or lcm-logger (its further parts are found), or a flight's folder")
      ->required();
  app.add_option("--planner-config", options.other.file, "What if: use the planner section of this scenario file")
      ->type_name("FILE");
  app.add_option("--set", options.other.settings,
                 "What if: change a setting, as planner.search.samples_xy=5 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--from", options.from_s, "Only answers from this time of the log on, seconds")->type_name("S");
  app.add_option("--to", options.to_s, "Only answers up to this time of the log, seconds")->type_name("S");
  app.add_option("--request", options.request, "Only answers to this request")->type_name("ID");
  app.add_option("--channel-suffix", options.suffix, "Suffix of the vehicle's channels")->type_name("S");
  app.add_option("--json", json, "Write the result, with a line per answer, to this file")->type_name("FILE");
  app.add_option("--save", save, "Write the selected answers and their inputs as a new, small log")->type_name("FILE");
  app.add_option("--dump", dump, "Write the answer to --request ID with its world as a text fixture for a unit test")
      ->type_name("FILE")
      ->needs("--request");
  return tern::run_tool(app, "tern-replay", argc, argv, [&] {
    const bool what_if = !options.other.empty();
    const tern::Replay replay = tern::value_or_throw(tern::replay_log(log, options));
    tern::value_or_throw(tern::write_extract(log, options, save, dump));
    fmt::print("{}", tern::replay_text(replay, what_if));
    if (!json.empty() && !tern::write_text(json, tern::replay_json(replay, what_if))) {
      throw tern::ConfigError(json + ": cannot be written");
    }
    return tern::replay_exit_code(replay, what_if);
  });
}
