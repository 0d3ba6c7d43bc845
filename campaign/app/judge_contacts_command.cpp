#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "campaign/app/commands.h"
#include "campaign/app/flight_options.h"
#include "campaign/experiments/avoidable.h"
#include "campaign/records/flight_table.h"
#include "campaign/statistics/wilson.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"

namespace tern {
namespace {

struct Options {
  FlightOptions flight;
  std::string flights;
  int moves = MoveSearch{}.moves;
};

/// Returns true if a vehicle that knows the truth could have avoided the contact of this seed's flight.
bool could_be_avoided(const FlightInputs& inputs, std::uint64_t seed, const MoveSearch& search) {
  ConfigDocument document = ConfigDocument::load(inputs.scenario_file, inputs.with_seed(seed));
  const Scenario scenario = read_scenario(document);
  const World world = value_or_throw(make_world(scenario, ""));
  const RestingVehicle vehicle{scenario.uav.start, scenario.uav.limits, scenario.uav.body, scenario.uav.flight_box};
  return clear_moves(vehicle, world, seed, search) > 0;
}

/// @throws ConfigError if the flights were flown in another world
void check_world(const FlightInputs& inputs, const Options& options, const Flights& flights) {
  if (flights.records.empty()) return;
  const auto& [seed, record] = *flights.records.begin();
  CampaignIdentity wanted = check_inputs(inputs, seed);
  wanted.charge = record.identity.charge;  // these two do not change the world
  wanted.version = record.identity.version;
  const std::string why = difference(record.identity, wanted);
  if (!why.empty()) throw ConfigError(options.flights + ": flights of another world: " + why);
}

int judge(const Options& options) {
  const FlightInputs inputs = inputs_of(options.flight);
  const Flights flights = value_of_file(read_flights(options.flights));
  check_world(inputs, options, flights);
  MoveSearch search;
  search.moves = options.moves;
  std::int64_t contacts = 0;
  std::vector<std::uint64_t> avoidable;
  for (const auto& [seed, record] : flights.records) {
    if (record.result.outcome != FlightOutcome::Collision) continue;
    ++contacts;
    if (could_be_avoided(inputs, seed, search)) avoidable.push_back(seed);
  }
  const auto n = static_cast<std::int64_t>(flights.records.size());
  const auto k = static_cast<std::int64_t>(avoidable.size());
  const Interval interval = wilson_interval(k, n);
  fmt::print("flights {}, contacts {}, of these avoidable {} ({:.3f} % of the flights [{:.3f}, {:.3f}])\n", n, contacts,
             k, n > 0 ? 100.0 * static_cast<double>(k) / static_cast<double>(n) : 0.0, 100.0 * interval.low,
             100.0 * interval.high);
  for (const std::uint64_t seed : avoidable) fmt::print("avoidable: seed {}\n", seed);
  return 0;
}

}  // namespace

void add_judge_contacts(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command = app.add_subcommand(
      "judge-contacts", "Find the contacts of a stationary vehicle that random moves would have avoided");
  add_world_options(command, options->flight);
  command->add_option("flights", options->flights, "Flights of a campaign in this world")
      ->required()
      ->type_name("FLIGHTS.csv");
  command->add_option("--moves", options->moves, "Number of random moves per contact")
      ->range(1, 100'000'000)
      ->capture_default_str();
  command->callback([&chosen, options] { chosen = [options] { return judge(*options); }; });
}

}  // namespace tern
