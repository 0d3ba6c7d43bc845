// tern-campaign: many seeded flights on virtual time, a line of CSV each.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "campaign/app/flight_line.h"
#include "runtime/config.h"
#include "runtime/process.h"

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
  bool trace = false;
  app.add_flag("--trace", trace, "Say every answer on stderr");
  CLI11_PARSE(app, argc, argv);
  fmt::print("{}\n", tern::flight_columns());
  for (std::int64_t seed = first; seed <= last; ++seed) {
    std::vector<std::string> with_seed = overrides;
    with_seed.push_back("seed=" + std::to_string(seed));
    try {
      tern::PlanTracer tracer;
      const tern::VirtualFlight flight = tern::fly_virtually(scenario, with_seed, trace ? &tracer : nullptr);
      fmt::print("{}\n", tern::flight_line(seed, flight));
      std::fflush(stdout);
    } catch (const tern::ConfigError& error) {
      fmt::print(stderr, "{}\n", error.what());
      return tern::kExitBadConfiguration;
    }
  }
  return 0;
}
