#include "tools/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "core/base/files.h"
#include "runtime/config.h"
#include "tools/calibrate/coverage.h"
#include "tools/calibrate/prior_table.h"
#include "tools/calibrate/synthetic.h"

namespace tern::calibrate {
namespace {

void write(const std::string& file, const std::string& text) {
  if (!write_text(file, text)) throw std::runtime_error(file + " cannot be written");
}

// The classes of the bank's models must hold where nothing can be learnt. Their scores come from a tracker without the
// learnt model.
Source source_of(const std::string& name, double weight, const std::vector<ScoredPrediction>& learning,
                 const std::vector<ScoredPrediction>& without_learning) {
  Source source{name, weight, without_learning};
  std::ranges::copy_if(learning, std::back_inserter(source.scored),
                       [](const ScoredPrediction& one) { return one.of.motion == MotionKind::Learnt; });
  return source;
}

}  // namespace

void calibrate(const CalibrationRequest& request) {
  Study sum;
  std::vector<Source> sources, slow;
  const auto add_study = [&](const Recording& recording, Study& without_learning, Study& learning) {
    add(learning, study(recording, TrackerConfig{}));
    TrackerConfig bank_only;
    bank_only.learns = false;
    if (!request.prior.empty()) add(without_learning, study(recording, bank_only));
  };
  for (const SyntheticSource& source : synthetic_sources()) {
    Study without_learning, learning;
    for (int seed = 1; seed <= request.synthetic; ++seed) {
      add_study(synthetic_recording(source, static_cast<std::uint64_t>(seed)), without_learning, learning);
    }
    add(sum, learning);
    if (!source.is_predictable) without_learning = Study{};
    sources.push_back(source_of(std::string(source.name), source.weight, learning.scored, without_learning.scored));
    slow.push_back(
        source_of(std::string(source.name), source.weight, learning.scored_slow, without_learning.scored_slow));
  }
  for (const std::string& log : request.logs) {
    const Recording recording = value_or_throw(read_recording(log));
    Study without_learning, learning;
    add_study(recording, without_learning, learning);
    add(sum, learning);
    sources.push_back(source_of(recording.name, 1.0, learning.scored, without_learning.scored));
    slow.push_back(source_of(recording.name, 1.0, learning.scored_slow, without_learning.scored_slow));
  }
  const std::string table = coverage_table(sum);
  fmt::print("{}", table);
  if (!request.csv.empty()) write(request.csv, table);
  if (!request.prior.empty()) write(request.prior, prior_table(sources, slow));
}

}  // namespace tern::calibrate
