#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "campaign/app/commands.h"
#include "campaign/app/flight_options.h"
#include "campaign/app/progress_output.h"
#include "campaign/campaign.h"
#include "campaign/experiments/exposure_summary.h"
#include "campaign/experiments/figure_data.h"
#include "campaign/experiments/search_experiment.h"
#include "campaign/experiments/semantic_flights.h"
#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/log.h"

namespace tern {
namespace {

struct Options {
  std::string out = "results";
  std::vector<std::string> settings;  ///< key=value
  std::uint64_t seeds = 0;
  int jobs = 1;
  bool sweep = false;
};

void write(const std::string& folder, const std::string& name, const std::string& text) {
  const std::string file = folder + "/" + name;
  if (!write_text(file, text)) throw FileError(file + ": cannot be written");
  fmt::print("{}\n", file);
}

int search(const Options& options) {
  std::filesystem::create_directories(options.out);
  std::string table = search_columns() + "\n";
  std::vector<SearchOutcome> outcomes;
  for (const SearchCase& c : search_cases()) {
    outcomes.push_back(run_search_case(c, options.settings));
    table += to_csv(c, outcomes.back()) + "\n";
  }
  write(options.out, "paper_6_1.csv", table);
  write(options.out, "paper_6_1.json", search_data(outcomes));
  return 0;
}

/// Flies seeds 1 to `seeds` as a campaign of its own in the folder.
std::vector<SemanticFlight> fly(const SemanticCase& wanted, std::uint64_t seeds, int jobs, const std::string& folder) {
  FlightOptions flight;
  flight.world = wanted.world;
  flight.settings = overrides_of(wanted);
  flight.charge = "counts";
  CampaignOptions campaign;
  campaign.inputs = inputs_of(flight);
  campaign.last_seed = seeds;
  campaign.jobs = jobs;
  campaign.out = fmt::format("{}/{}-{}-{}.csv", folder, wanted.world, wanted.method, wanted.lambda);
  campaign.failures = default_failures(campaign.out);
  fmt::print(stderr, "{}\n", campaign.out);
  ProgressOutput output;
  const auto end =
      run_campaign(campaign, flight_command(flight), -1, [&](const CampaignProgress& p) { output.show(p); });
  output.finish();
  value_of_file(end);
  const Flights flown = value_of_file(read_flights(campaign.out));
  std::vector<SemanticFlight> flights;
  for (const auto& [seed, record] : flown.records) flights.push_back(semantic_flight(wanted, record));
  std::erase_if(flights, [seeds](const SemanticFlight& f) { return f.seed > seeds; });
  return flights;
}

FlightTrack track_of(const SemanticCase& wanted) {
  std::vector<std::string> overrides = overrides_of(wanted);
  overrides.emplace_back("seed=1");
  return fly_and_track(value_or_throw(find_scenario(wanted.world)), overrides);
}

int corridor(const Options& options) {
  log::start("tern", "warning");
  const std::string name = options.sweep ? "paper_6_2_sweep" : "paper_6_2";
  const std::string folder = options.out + "/" + name;
  std::filesystem::create_directories(folder);
  const std::uint64_t seeds = options.seeds > 0 ? options.seeds : (options.sweep ? 10 : 100);
  std::vector<SemanticFlight> flights;
  for (const SemanticCase& wanted : options.sweep ? sweep_cases() : on_off_cases()) {
    const std::vector<SemanticFlight> own = fly(wanted, seeds, options.jobs, folder);
    flights.insert(flights.end(), own.begin(), own.end());
  }
  std::stable_sort(flights.begin(), flights.end(), [](const auto& a, const auto& b) { return a.seed < b.seed; });
  const std::vector<ExposureSummary> summaries = summarize_exposure(flights);
  write(options.out, name + "_flights.csv", to_csv(flights));
  write(options.out, name + ".csv", to_csv(summaries));
  write(options.out, name + ".md", to_markdown(summaries));
  if (options.sweep) return 0;
  for (const SemanticWorld& world : semantic_worlds()) {
    write(options.out, name + "_" + world.scenario + ".json",
          corridor_data(track_of({world.scenario, "off", 0.0}), track_of({world.scenario, "exposure+path", 2.0})));
  }
  return 0;
}

}  // namespace

void add_paper(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine alone = app.add_subcommand(
      "paper-6.1", "Section 6.1 of the paper: the search alone in three cases. Writes CSV, and JSON for the figure");
  CommandLine flights = app.add_subcommand(
      "paper-6.2",
      "Section 6.2 of the paper: flights with semantics on and off. Writes CSV, Markdown, and JSON for the figures");
  for (CommandLine command : {alone, flights}) {
    command->add_option("--out", options->out, "Folder for the files")->type_name("DIR")->capture_default_str();
  }
  alone->add_option("--set", options->settings, "Override a value of the scenario file (repeatable)")
      ->type_name("KEY=VALUE");
  flights->add_option("--seeds", options->seeds, "Seeds 1 to N of each world (default 100; with --sweep 10)")
      ->type_name("N");
  flights->add_option("--jobs", options->jobs, "Number of flights at a time")->range(1, 10'000)->capture_default_str();
  flights->add_flag("--sweep", options->sweep, "Instead vary λ from 0 to 8 with each method");
  alone->callback([&chosen, options] { chosen = [options] { return search(*options); }; });
  flights->callback([&chosen, options] { chosen = [options] { return corridor(*options); }; });
}

}  // namespace tern
