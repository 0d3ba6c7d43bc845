#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "campaign/app/commands.h"
#include "campaign/experiments/exposure_summary.h"
#include "campaign/experiments/figure_data.h"
#include "campaign/experiments/search_experiment.h"
#include "campaign/experiments/semantic_flights.h"
#include "campaign/flight_inputs.h"
#include "runtime/config.h"

namespace tern {
namespace {

struct Options {
  std::string out = "results";
  std::vector<std::string> settings;  ///< key=value
  std::string one;                    ///< a single flight's case: this process flies it
  std::uint64_t seeds = 0;
  int jobs = 1;
  bool sweep = false;
};

void write(const std::string& folder, const std::string& name, const std::string& text) {
  const std::string file = folder + "/" + name;
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw ConfigError("cannot write " + file);
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

int fly_one_case(const std::string& words) {
  spdlog::set_default_logger(spdlog::stderr_color_st("tern"));  // standard output is for the result
  const auto wanted = parse_semantic_case(words);
  if (!wanted) throw ConfigError(wanted.error().message);
  fmt::print("{}\n", to_csv(fly_semantic_case(*wanted)));
  return std::fflush(stdout) == 0 ? 0 : 1;
}

FlightTrack track_of(const SemanticCase& wanted) {
  const auto file = find_scenario(wanted.world);
  if (!file) throw ConfigError(file.error().message);
  return fly_and_track(*file, overrides_of(wanted));
}

int corridor(const Options& options) {
  if (!options.one.empty()) return fly_one_case(options.one);
  spdlog::set_level(spdlog::level::warn);
  std::filesystem::create_directories(options.out);
  const std::string name = options.sweep ? "paper_6_2_sweep" : "paper_6_2";
  const std::uint64_t seeds = options.seeds > 0 ? options.seeds : (options.sweep ? 10 : 100);
  SemanticCampaign campaign;
  campaign.file = options.out + "/" + name + "_flights.csv";
  campaign.cases = options.sweep ? sweep_cases(seeds) : on_off_cases(seeds);
  campaign.command = {std::filesystem::read_symlink("/proc/self/exe").string(), "paper-6.2", "--one"};
  campaign.jobs = options.jobs;
  campaign.report = [](std::size_t done, std::size_t all) { fmt::print(stderr, "\r{} of {} flights", done, all); };
  const auto flights = fly_semantic_cases(campaign);
  fmt::print(stderr, "\n");
  if (!flights) throw ConfigError(flights.error().message);
  const std::vector<ExposureSummary> summaries = summarize_exposure(*flights);
  fmt::print("{}\n", campaign.file);
  write(options.out, name + ".csv", to_csv(summaries));
  write(options.out, name + ".md", to_markdown(summaries));
  if (options.sweep) return 0;
  for (const SemanticWorld& world : semantic_worlds()) {
    write(
        options.out, name + "_" + world.scenario + ".json",
        corridor_data(track_of({world.scenario, "off", 0.0, 1}), track_of({world.scenario, "exposure+path", 2.0, 1})));
  }
  return 0;
}

}  // namespace

void add_paper(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* alone =
      app.add_subcommand("paper-6.1", "The paper's 6.1: the search alone, three cases; CSV, and JSON for the figure");
  CLI::App* flights = app.add_subcommand(
      "paper-6.2", "The paper's 6.2: flights with semantics on against off; CSV, Markdown, and JSON for the figures");
  for (CLI::App* command : {alone, flights}) {
    command->add_option("--out", options->out, "Folder for the files")->type_name("DIR")->capture_default_str();
  }
  alone->add_option("--set", options->settings, "Override key=value (repeatable)")->type_name("KEY=VALUE");
  auto* const seeds =
      flights->add_option("--seeds", options->seeds, "Seeds 1 to N of each (default 100, with --sweep 10)")
          ->type_name("N");
  auto* const jobs = flights->add_option("--jobs", options->jobs, "Flights at once");
  jobs->check(CLI::Range(1, 10'000))->capture_default_str();
  auto* const sweep = flights->add_flag("--sweep", options->sweep, "λ from 0 to 8 with each method instead");
  flights->add_option("--one", options->one, "Fly WORLD,METHOD,LAMBDA,SEED in this process: one line of CSV")
      ->excludes(seeds)
      ->excludes(jobs)
      ->excludes(sweep);
  alone->callback([&chosen, options] { chosen = [options] { return search(*options); }; });
  flights->callback([&chosen, options] { chosen = [options] { return corridor(*options); }; });
}

}  // namespace tern
