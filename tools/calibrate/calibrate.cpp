#include "tools/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <vector>

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

// Given models' classes hold in worlds where nothing can be learnt, so they are of a tracker that does not learn.
Source source_of(const std::string& name, double weight, const std::vector<Judged>& learning,
                 const std::vector<Judged>& given) {
  Source source{name, weight, given};
  std::ranges::copy_if(learning, std::back_inserter(source.judged),
                       [](const Judged& one) { return one.kind == TrackClass::Learnt; });
  return source;
}

}  // namespace

void calibrate(const CalibrationRequest& request) {
  Study sum;
  std::vector<Source> sources, slow;
  const auto judge = [&](const Recording& recording, Study& given, Study& learning) {
    add(learning, study(recording, TrackerConfig{}));
    TrackerConfig unlearnt;
    unlearnt.learns = false;
    if (!request.prior.empty()) add(given, study(recording, unlearnt));
  };
  for (const MadeUpSource& source : made_up_sources()) {
    Study given, learning;
    for (int seed = 1; seed <= request.made_up; ++seed) {
      judge(made_up(source, static_cast<std::uint64_t>(seed)), given, learning);
    }
    add(sum, learning);
    if (!source.is_foreseen) given = Study{};
    sources.push_back(source_of(std::string(source.name), source.weight, learning.judged, given.judged));
    slow.push_back(source_of(std::string(source.name), source.weight, learning.slow, given.slow));
  }
  for (const std::string& log : request.logs) {
    const Recording recording = value_or_throw(read_recording(log));
    Study given, learning;
    judge(recording, given, learning);
    add(sum, learning);
    sources.push_back(source_of(recording.name, 1.0, learning.judged, given.judged));
    slow.push_back(source_of(recording.name, 1.0, learning.slow, given.slow));
  }
  const std::string table = coverage_table(sum);
  fmt::print("{}", table);
  if (!request.csv.empty()) write(request.csv, table);
  if (!request.prior.empty()) write(request.prior, prior_table(sources, slow));
}

}  // namespace tern::calibrate
