// tern-campaign: many seeded flights on virtual time, a line of CSV each.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "campaign/virtual_flight.h"
#include "runtime/config.h"
#include "runtime/process.h"

namespace {

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print_flight(std::int64_t seed, const tern::VirtualFlight& f) {
  std::vector<double> total;
  std::vector<double> first;
  for (const tern::PlanTiming& t : f.timings) {
    total.push_back(t.cpu_ms);
    first.push_back(t.first_answer_ms);
  }
  fmt::print("{},{},{:.3f},{:.3f},{:.2f},{},{:.3f},{},{},{},{},{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},\"{}\"\n", seed,
             tern::to_string(f.result.outcome), f.result.flight_time_s, f.result.first_entry_s, f.result.top_speed_mps,
             f.result.stops, f.result.min_clearance_m, f.executor.requests, f.executor.answered_in_time,
             f.outcomes[0], f.outcomes[1], f.outcomes[2], f.outcomes[3], f.outcomes[4], percentile(total, 0.5),
             percentile(total, 0.99), percentile(first, 0.5), percentile(first, 0.99), f.result.detail);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Flies a scenario with many seeds on virtual time; a line of CSV per flight."};
  std::string scenario;
  std::vector<std::string> overrides;
  std::int64_t first = 1;
  std::int64_t last = 10;
  app.add_option("--config", scenario, "Scenario file")->required();
  app.add_option("--set", overrides, "Override key=value (repeatable)");
  app.add_option("--first", first, "First seed");
  app.add_option("--last", last, "Last seed");
  CLI11_PARSE(app, argc, argv);
  fmt::print("seed,outcome,flight_time_s,first_entry_s,top_speed_mps,stops,min_clearance_m,requests,answered_in_time,optimized,"
             "search_only,keep_committed,evade,no_plan,cpu_p50_ms,cpu_p99_ms,first_p50_ms,first_p99_ms,detail\n");
  for (std::int64_t seed = first; seed <= last; ++seed) {
    std::vector<std::string> with_seed = overrides;
    with_seed.push_back("seed=" + std::to_string(seed));
    try {
      print_flight(seed, tern::fly_virtually(scenario, with_seed));
    } catch (const tern::ConfigError& error) {
      fmt::print(stderr, "{}\n", error.what());
      return tern::kExitBadConfiguration;
    }
  }
  return 0;
}
