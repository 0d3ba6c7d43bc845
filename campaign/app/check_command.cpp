#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "campaign/app/commands.h"
#include "campaign/app/flight_options.h"
#include "campaign/experiments/scenario_drawing.h"
#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"

namespace tern {
namespace {

constexpr int kExitUnreachable = 1;

struct Options {
  FlightOptions flight;
  std::optional<std::uint64_t> seed;
  std::string out;
};

int check(const Options& options) {
  const ScenarioView view = view_scenario(inputs_of(options.flight), options.seed);
  fmt::print("{}", to_text(view));
  if (!options.out.empty()) {
    const bool was_there = std::filesystem::exists(options.out);
    if (!write_text(options.out, draw_scenario(view))) throw FileError(options.out + ": cannot be written");
    fmt::print("  drawn     {}{}\n", options.out, was_there ? ", replacing the old file" : "");
  }
  return view.shortest ? 0 : kExitUnreachable;
}

}  // namespace

void add_check(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command = app.add_subcommand(
      "check",
      "Inspect a scenario without flying it: contents, drawing, path to the goal; exit code 1: there is no path");
  add_world_options(command, options->flight);
  command->add_option("--seed", options->seed, "Seed (default: the scenario's)");
  command->add_option("--out", options->out, "Draw it from above and from the side")->type_name("FILE.svg");
  command->callback([&chosen, options] { chosen = [options] { return check(*options); }; });
}

}  // namespace tern
