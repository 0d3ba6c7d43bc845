#include "tools/calibrate/prior_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "predictor/tracking/calibration.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern::calibrate {
namespace {

// θ is at least this, or no window of scores would hold it.
constexpr double kLeastLevel = 0.003;
// Of all promises, what each band may break even if those before it broke all that is allowed.
constexpr double kLeastBroken = 0.0005;

struct Weighed {
  const Judged* judged;
  double weight;
  bool broken = false;
};

struct Score {
  double score, weight;
  Weighed* of;
};

std::vector<Weighed> of_class(const std::vector<Source>& sources, TrackClass kind) {
  std::vector<Weighed> all;
  for (const Source& source : sources) {
    std::vector<const Judged*> own;
    for (const Judged& judged : source.judged) {
      if (judged.kind == kind) own.push_back(&judged);
    }
    if (own.size() < kFewPromises) continue;
    const double weight = source.weight / static_cast<double>(source.judged.size());
    for (const Judged* judged : own) all.push_back({judged, weight});
  }
  return all;
}

double weight_of(const std::vector<Score>& scores) {
  double sum = 0.0;
  for (const Score& score : scores) sum += score.weight;
  return sum;
}

// The score below which the share `p` of the weight lies. @pre ascending, not empty.
double quantile(const std::vector<Score>& scores, double p) {
  const double until = p * weight_of(scores);
  double sum = 0.0;
  for (const Score& score : scores) {
    sum += score.weight;
    if (sum >= until) return score.score;
  }
  return scores.back().score;
}

// Breaks what is beyond the band's margin. @return θ.
double break_band(std::vector<Score>& scores, double allowed) {
  const double all = weight_of(scores);
  double left = allowed * all;
  for (const Score& score : scores) left -= score.of->broken ? score.weight : 0.0;
  left = std::max(left, kLeastBroken * all);
  double margin = scores.back().score;
  for (auto score = scores.rbegin(); score != scores.rend(); ++score) {
    if (score->of->broken) continue;
    margin = score->score;
    left -= score->weight;
    if (left < 0.0) break;
  }
  double above = 0.0;
  for (const Score& score : scores) {
    if (score.score <= margin) continue;
    above += score.weight;
    score.of->broken = true;
  }
  return std::max(kLeastLevel, above / all);
}

std::string row(std::vector<Weighed>& all, std::size_t band, double allowed) {
  std::vector<Score> scores;
  for (Weighed& weighed : all) {
    if (weighed.judged->bands > band) {
      scores.push_back({static_cast<double>(weighed.judged->scores[band]), weighed.weight, &weighed});
    }
  }
  std::sort(scores.begin(), scores.end(), [](const Score& a, const Score& b) { return a.score < b.score; });
  std::string text = "    {";
  if (scores.empty()) return text + "0.01, {}},";
  text += fmt::format("{:.4f}, {{", break_band(scores, allowed));
  for (std::size_t k = 0; k < kPriorProbabilities.size(); ++k) {
    const double p = std::min(kPriorProbabilities[k], kPriorLast);
    text += fmt::format("{}{:.3f}", k == 0 ? "" : ", ", quantile(scores, p));
  }
  return text + "}},";
}

}  // namespace

std::string prior_table(const std::vector<Source>& sources) {
  const Calibration calibration(1.0 - kPriorMiss);
  std::string text;
  for (std::size_t kind = 0; kind < kTrackClasses; ++kind) {
    std::vector<Weighed> all = of_class(sources, static_cast<TrackClass>(kind));
    for (std::size_t band = 0; band < kBands; ++band) {
      text += row(all, band, calibration.allowed(band)) +
              fmt::format("  // class {}, to {} s, of {} promises\n", kind, kBandEnds[band], all.size());
    }
  }
  return text;
}

}  // namespace tern::calibrate
