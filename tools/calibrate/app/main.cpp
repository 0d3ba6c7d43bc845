// tern-calibrate: holds predictions against what came, in logs of flights, and makes the table that calibration begins
// with.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "tools/calibrate/coverage.h"
#include "tools/calibrate/made_up.h"
#include "tools/calibrate/prior_table.h"

namespace {

using namespace tern;

constexpr int kUnreadable = 2;

void write(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw std::runtime_error(file + " cannot be written");
}

int run(const std::vector<std::string>& logs, int made_up, const std::string& csv, const std::string& prior) {
  calibrate::Study sum;
  std::vector<calibrate::Source> sources;
  for (const calibrate::MadeUpSource& source : calibrate::made_up_sources()) {
    calibrate::Study all;
    for (int seed = 1; seed <= made_up; ++seed) {
      const auto recording = calibrate::made_up(source, static_cast<std::uint64_t>(seed));
      calibrate::add(all, calibrate::study(recording, TrackerConfig{}));
    }
    calibrate::add(sum, all);
    sources.push_back({std::string(source.name), source.weight, all.judged});
  }
  for (const std::string& log : logs) {
    const auto recording = calibrate::read_recording(log);
    if (!recording) throw std::runtime_error(recording.error().message);
    const calibrate::Study study = calibrate::study(*recording, TrackerConfig{});
    calibrate::add(sum, study);
    sources.push_back({recording->name, 1.0, study.judged});
  }
  const std::string table = calibrate::coverage_table(sum);
  fmt::print("{}", table);
  if (!csv.empty()) write(csv, table);
  if (!prior.empty()) write(prior, calibrate::prior_table(sources));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Predicts the obstacles of recorded flights anew from their detections, and says how often and how widely "
      "promises were kept. Exit code: 0, or 2 for bad arguments or logs."};
  std::vector<std::string> logs;
  int made_up = 0;
  std::string csv, prior;
  app.add_option("LOG", logs, "Logs: files, or folders of flight.lcm");
  app.add_option("--made-up", made_up, "So many recordings of made-up movers of each kind, too")
      ->check(CLI::Range(0, 100));
  app.add_option("--csv", csv, "Write the table there, too")->type_name("FILE");
  app.add_option("--prior", prior, "Write the table that calibration begins with, of these logs")->type_name("FILE");
  try {
    app.parse(argc, argv);
    return run(logs, made_up, csv, prior);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUnreadable;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tern-calibrate: {}\n", error.what());
    return kUnreadable;
  }
}
