#include "tools/calibrate/calibrate.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/base/files.h"
#include "runtime/config.h"
#include "tools/calibrate/coverage.h"
#include "tools/calibrate/made_up.h"
#include "tools/calibrate/prior_table.h"

namespace tern::calibrate {
namespace {

void write(const std::string& file, const std::string& text) {
  if (!write_text(file, text)) throw std::runtime_error(file + " cannot be written");
}

}  // namespace

void calibrate(const CalibrationRequest& request) {
  Study sum;
  std::vector<Source> sources, slow;
  for (const MadeUpSource& source : made_up_sources()) {
    Study all;
    for (int seed = 1; seed <= request.made_up; ++seed) {
      const auto recording = made_up(source, static_cast<std::uint64_t>(seed));
      add(all, study(recording, TrackerConfig{}));
    }
    add(sum, all);
    sources.push_back({std::string(source.name), source.weight, all.judged});
    slow.push_back({std::string(source.name), source.weight, all.slow});
  }
  for (const std::string& log : request.logs) {
    const Recording recording = or_refuse(read_recording(log));
    const Study of_log = study(recording, TrackerConfig{});
    add(sum, of_log);
    sources.push_back({recording.name, 1.0, of_log.judged});
    slow.push_back({recording.name, 1.0, of_log.slow});
  }
  const std::string table = coverage_table(sum);
  fmt::print("{}", table);
  if (!request.csv.empty()) write(request.csv, table);
  if (!request.prior.empty())
    write(request.prior, "    // worlds of any pace\n" + prior_table(sources, sources) + "    // slow worlds\n" +
                             prior_table(slow, sources));
}

}  // namespace tern::calibrate
