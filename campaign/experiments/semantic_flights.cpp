#include "campaign/experiments/semantic_flights.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "campaign/flight_inputs.h"
#include "campaign/virtual_flight.h"
#include "campaign/workers/process_pool.h"
#include "core/world/names.h"
#include "planner/planner_build.h"
#include "runtime/config.h"

namespace tern {
namespace {

constexpr double kLambda = 2.0;           // the paper's, 6.2
constexpr std::int64_t kCpuLimit = 1800;  // s

std::string planner_name() { return fmt::format("{:016x}", planner_build()); }

const SemanticWorld& world_of(const std::string& scenario) {
  for (const SemanticWorld& world : semantic_worlds()) {
    if (world.scenario == scenario) return world;
  }
  throw std::invalid_argument("no semantic world " + scenario);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

/// By words_of their cases. A file that is not there has none.
Result<std::map<std::string, SemanticFlight>> read_flights_of(const std::string& file) {
  std::map<std::string, SemanticFlight> flights;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    auto flight = parse_semantic_flight(line);
    if (!flight) return fail(file + ": " + flight.error().message);
    if (flight->planner != planner_name()) {
      return fail(fmt::format("{} holds flights of planner {}, this is {}: remove it or choose another folder", file,
                              flight->planner, planner_name()));
    }
    flights.emplace(words_of(flight->flown), std::move(*flight));
  }
  return flights;
}

Result<std::vector<SemanticFlight>> write_sorted(const SemanticCampaign& campaign,
                                                 const std::map<std::string, SemanticFlight>& flown) {
  std::vector<SemanticFlight> wanted;
  std::ofstream out(campaign.file + ".sorted");
  out << semantic_flight_columns() << "\n";
  for (const SemanticCase& c : campaign.cases) {
    wanted.push_back(flown.at(words_of(c)));
    out << to_csv(wanted.back()) << "\n";
  }
  out.close();
  if (!out || std::rename((campaign.file + ".sorted").c_str(), campaign.file.c_str()) != 0) {
    return fail("cannot write " + campaign.file);
  }
  return wanted;
}

}  // namespace

const std::vector<SemanticMethod>& semantic_methods() {
  static const std::vector<SemanticMethod> kMethods = {
      {"off", "without semantics", {"semantics.enabled=false"}},
      {"mean_distance", "mean distance (the paper's)", {"semantics.cost=mean_distance", "planner.semantic_path=false"}},
      {"mean_distance+path", "mean distance, path knows regions", {"semantics.cost=mean_distance"}},
      {"exposure", "exposure", {"semantics.cost=exposure", "planner.semantic_path=false"}},
      {"exposure+path", "exposure, path knows regions (default)", {"semantics.cost=exposure"}}};
  return kMethods;
}

const SemanticMethod& semantic_method(const std::string& name) {
  for (const SemanticMethod& method : semantic_methods()) {
    if (method.name == name) return method;
  }
  throw std::invalid_argument("no semantic method " + name);
}

const std::vector<SemanticWorld>& semantic_worlds() {
  static const std::vector<SemanticWorld> kWorlds = {{"paper_attract", "semantics.lambda_attractive", true},
                                                     {"paper_repel", "semantics.lambda_repulsive", false}};
  return kWorlds;
}

std::vector<SemanticCase> on_off_cases(std::uint64_t seeds) {
  std::vector<SemanticCase> cases;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const SemanticWorld& world : semantic_worlds()) {
      cases.push_back({world.scenario, "off", 0.0, seed});
      for (const char* method : {"mean_distance", "exposure+path"}) {
        cases.push_back({world.scenario, method, kLambda, seed});
      }
    }
  }
  return cases;
}

std::vector<SemanticCase> sweep_cases(std::uint64_t seeds) {
  std::vector<SemanticCase> cases;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const SemanticWorld& world : semantic_worlds()) {
      for (const SemanticMethod& method : semantic_methods()) {
        if (method.name == "off") {
          cases.push_back({world.scenario, method.name, 0.0, seed});
          continue;
        }
        for (const double lambda : kSweepLambdas) cases.push_back({world.scenario, method.name, lambda, seed});
      }
    }
  }
  return cases;
}

std::vector<std::string> overrides_of(const SemanticCase& wanted) {
  std::vector<std::string> overrides = semantic_method(wanted.method).overrides;
  overrides.push_back("seed=" + std::to_string(wanted.seed));
  if (wanted.method != "off")
    overrides.push_back(fmt::format("{}={}", world_of(wanted.world).lambda_key, wanted.lambda));
  overrides.insert(overrides.end(), {"uav.flight_box.min=[-100, -100, 0]", "uav.flight_box.max=[200, 100, 4]"});
  return overrides;
}

SemanticFlight fly_semantic_case(const SemanticCase& wanted) {
  const auto file = find_scenario(wanted.world);
  if (!file) throw ConfigError(file.error().message);
  const VirtualFlight flown = fly_virtually(*file, overrides_of(wanted));
  SemanticFlight flight;
  flight.flown = wanted;
  flight.outcome = flown.result.outcome;
  flight.flight_time_s = flown.result.flight_time_s;
  flight.path_length_m = flown.result.path_length_m;
  flight.min_clearance_m = flown.result.min_clearance_m;
  if (!flown.result.exposure.empty()) flight.exposure = flown.result.exposure.front();
  flight.planner = planner_name();
  return flight;
}

std::string semantic_flight_columns() {
  return "world,method,lambda,seed,outcome,flight_time_s,path_length_m,min_clearance_m,inside_m,inside_s,near_m,near_s,"
         "planner";
}

std::string to_csv(const SemanticFlight& f) {
  return fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}", f.flown.world,
                     f.flown.method, f.flown.lambda, f.flown.seed, to_string(f.outcome), f.flight_time_s,
                     f.path_length_m, f.min_clearance_m, f.exposure.metres, f.exposure.seconds, f.exposure.near_metres,
                     f.exposure.near_seconds, f.planner);
}

std::string words_of(const SemanticCase& c) { return fmt::format("{},{},{},{}", c.world, c.method, c.lambda, c.seed); }

Result<SemanticCase> parse_semantic_case(const std::string& words) {
  const std::vector<std::string> cells = cells_of(words);
  if (cells.size() != 4) return fail("not WORLD,METHOD,LAMBDA,SEED: " + words);
  try {
    return SemanticCase{cells[0], cells[1], std::stod(cells[2]), std::stoull(cells[3])};
  } catch (const std::exception&) {
    return fail("no number for lambda or seed: " + words);
  }
}

Result<SemanticFlight> parse_semantic_flight(const std::string& line) {
  const std::vector<std::string> cells = cells_of(line);
  constexpr std::size_t kCells = 13;
  if (cells.size() != kCells) return fail(fmt::format("{} cells instead of {}: {}", cells.size(), kCells, line));
  try {
    SemanticFlight f;
    f.flown = {cells[0], cells[1], std::stod(cells[2]), std::stoull(cells[3])};
    f.outcome = named<FlightOutcome>(cells[4]).value_or(FlightOutcome::Failed);
    f.flight_time_s = std::stod(cells[5]);
    f.path_length_m = std::stod(cells[6]);
    f.min_clearance_m = std::stod(cells[7]);
    f.exposure = {"", std::stod(cells[9]), std::stod(cells[8]), std::stod(cells[11]), std::stod(cells[10])};
    f.planner = cells[12];
    return f;
  } catch (const std::exception&) {
    return fail("a cell is no number: " + line);
  }
}

Result<std::vector<SemanticFlight>> fly_semantic_cases(const SemanticCampaign& campaign) {
  auto read = read_flights_of(campaign.file);
  if (!read) return tl::unexpected(read.error());
  std::map<std::string, SemanticFlight> flown = std::move(*read);
  std::ofstream out(campaign.file, std::ios::app);
  if (out.tellp() == 0) out << semantic_flight_columns() << "\n";
  ProcessPool pool;
  std::size_t next = 0;
  std::size_t done = 0;
  for (const SemanticCase& c : campaign.cases) done += flown.contains(words_of(c)) ? 1U : 0U;
  while (next < campaign.cases.size() || pool.running() > 0) {
    while (next < campaign.cases.size() && pool.running() < static_cast<std::size_t>(campaign.jobs)) {
      const std::string words = words_of(campaign.cases[next++]);
      if (flown.contains(words)) continue;
      std::vector<std::string> command = campaign.command;
      command.push_back(words);
      pool.start(next, command, campaign.file + ".log", kCpuLimit);
    }
    bool stop = false;
    for (const FinishedProcess& process : pool.wait(-1, 1000, stop)) {
      auto flight = parse_semantic_flight(process.output.substr(0, process.output.find('\n')));
      if (process.exit_code != 0 || !flight) {
        return fail(fmt::format("{}: the flight's process died, see {}.log", words_of(campaign.cases[process.key - 1]),
                                campaign.file));
      }
      out << to_csv(*flight) << std::endl;
      flown.emplace(words_of(flight->flown), std::move(*flight));
      if (campaign.report) campaign.report(++done, campaign.cases.size());
    }
  }
  if (!out) return fail("cannot write " + campaign.file);
  out.close();
  return write_sorted(campaign, flown);
}

}  // namespace tern
