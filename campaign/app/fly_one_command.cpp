#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "campaign/app/commands.h"
#include "campaign/app/flight_options.h"
#include "campaign/app/plan_tracer.h"
#include "campaign/campaign.h"
#include "campaign/recorded_flight.h"
#include "runtime/command_line.h"
#include "runtime/log.h"

namespace tern {
namespace {

struct Options {
  FlightOptions flight;
  std::uint64_t seed = 1;
  std::string folder = "flight";
  bool trace = false;
};

int fly_one(const Options& options) try {
  log::start("tern", "info");  ///< standard output is for the result
  const FlightInputs inputs = inputs_of(options.flight);
  const CampaignIdentity identity = check_inputs(inputs, options.seed);
  std::filesystem::create_directories(options.folder);
  PlanTracer tracer;
  const bool judges = options.flight.coverage.empty();
  const Auditor auditor{judges ? options.flight.audit : options.flight.coverage, judges};
  const RecordedFlight flight =
      fly_recorded(inputs, options.seed, identity, options.folder, auditor, options.trace ? &tracer : nullptr);
  for (const auto& [process, words] : flight.said) log::warn("{}: {}", process, words);
  fmt::print("{}", encode_flight(flight.record, flight.times));
  return std::fflush(stdout) == 0 ? 0 : kExitCannotWrite;
} catch (const CannotRecord& error) {
  fmt::print(stderr, "{}\n", error.what());
  return kExitCannotWrite;
}

}  // namespace

void add_fly_one(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command =
      app.add_subcommand("fly-one", "Fly one seed in this process and record it; prints two lines of CSV");
  add_flight_options(command, options->flight);
  command->add_option("--seed", options->seed, "Seed")->capture_default_str();
  command->add_option("--folder", options->folder, "Folder for scenario.yaml, flight.lcm and summary.json")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--trace", options->trace, "Print every answer on stderr");
  command->callback([&chosen, options] { chosen = [options] { return fly_one(*options); }; });
}

}  // namespace tern
