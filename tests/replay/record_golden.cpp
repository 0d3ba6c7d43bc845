// record_golden FOLDER: flies the golden flights and writes a log of each (launch_scripts/record_golden.sh).
#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "tests/replay/golden_flights.h"
#include "tools/replay/extract.h"

namespace {

/// Removes measured times, which would differ in every recording.
void keep_counts_only(tern::RecordedPlan& recorded) {
  if (!recorded.timing) return;
  tern::PlanTiming& t = *recorded.timing;
  t.total_ms = t.first_answer_ms = t.cpu_ms = 0.0;
  for (double& ms : t.stage_ms) ms = 0.0;
  t.peak_rss_kb = 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    for (const tern::testing::GoldenFlight& golden : tern::testing::golden_flights()) {
      const std::string whole = fmt::format("{}/{}.whole.lcm", argv[1], golden.name);
      tern::testing::record_virtually(golden.flight, whole);
      tern::ReplayOptions options;
      options.from_s = golden.from_s;
      auto small = tern::extract(whole, options, golden.every);
      std::filesystem::remove(whole);
      if (!small) throw std::runtime_error(small.error().message);
      for (tern::RecordedPlan& recorded : small->inputs.plans) keep_counts_only(recorded);
      const auto written = tern::write_log(*small, fmt::format("{}/{}.lcm", argv[1], golden.name));
      if (!written) throw std::runtime_error(written.error().message);
      fmt::print("{:<12} {} answers\n", golden.name, small->inputs.plans.size());
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "record_golden: {}\n", error.what());
    return 1;
  }
  return 0;
}
