#include "campaign/app/flight_options.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "runtime/command_line.h"
#include "runtime/config.h"

namespace tern {
namespace {

bool can_run(const std::string& file) {
  return std::filesystem::is_regular_file(file) && access(file.c_str(), X_OK) == 0;
}

/// Returns why a program cannot be run, or "". @param program  a path, or a name in $PATH, as execvp() takes it
std::string why_not_run(const std::string& program) {
  bool runs = program.find('/') != std::string::npos && can_run(program);
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr || program.find('/') != std::string::npos ? "" : path);
  for (std::string folder; !runs && std::getline(folders, folder, ':');) {
    runs = can_run(std::filesystem::path(folder) / program);
  }
  return runs ? "" : program + ": is not an executable program";
}

}  // namespace

void add_world_options(CommandLine& app, FlightOptions& options) {
  app.add_option("--world", options.world, "Scenario: a file, or a name in scenarios/")->type_name("NAME|FILE");
  app.add_option("--count", options.count, "Number of obstacles (world.count)")->type_name("N")->non_negative();
  app.add_option("--set", options.settings, "Override a value of the scenario file (repeatable)")
      ->type_name("KEY=VALUE")
      ->take_all();
}

void add_flight_options(CommandLine& app, FlightOptions& options) {
  add_world_options(app, options);
  app.add_option("--charge", options.charge, "Virtual time that planning takes: the CPU time of its thread, or 15 ms")
      ->one_of({"cpu", "counts"})
      ->capture_default_str();
  CommandOption audit = app.add_option("--audit", options.audit,
                                       "Run this program on every log (exit code 0: passed, 1: broken) and record its "
                                       "coverage of predictions")
                            ->type_name("PROGRAM")
                            ->check(why_not_run);
  app.add_option("--coverage", options.coverage, "Like --audit, but record the coverage only, not the verdict")
      ->type_name("PROGRAM")
      ->check(why_not_run)
      ->excludes(audit);
  app.add_flag("--oracle", options.oracle,
               "Declare the motion of every obstacle: the same flights with perfect prediction");
}

FlightInputs inputs_of(const FlightOptions& options) {
  if (options.world.empty()) throw ConfigError("--world is required: a scenario's file or name");
  FlightInputs inputs;
  inputs.scenario_file = value_or_throw(find_scenario(options.world), "--world: ");
  inputs.overrides = options.settings;
  if (!options.count.empty()) inputs.overrides.push_back("world.count=" + options.count);
  if (options.oracle) {
    inputs.overrides.insert(inputs.overrides.end(),
                            {"simulator.declare=true", "simulator.sensor={mode: truth}", "simulator.sensors=[]"});
  }
  inputs.charge = options.charge == "cpu" ? Charge::Cpu : Charge::Counts;
  for (const std::string& setting : options.settings) {
    if (setting.starts_with("seed=")) throw ConfigError("--set " + setting + ": seeds are set by --seeds or --seed");
    if (setting.starts_with("logger.")) throw ConfigError("--set " + setting + ": no tern-logger runs in virtual time");
  }
  return inputs;
}

std::vector<std::string> flight_command(const FlightOptions& options) {
  std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe").string(), "fly-one"};
  words.insert(words.end(), {"--world", options.world, "--charge", options.charge});
  if (!options.count.empty()) words.insert(words.end(), {"--count", options.count});
  for (const std::string& setting : options.settings) words.insert(words.end(), {"--set", setting});
  if (options.oracle) words.emplace_back("--oracle");
  if (!options.audit.empty()) words.insert(words.end(), {"--audit", options.audit});
  if (!options.coverage.empty()) words.insert(words.end(), {"--coverage", options.coverage});
  return words;
}

}  // namespace tern
