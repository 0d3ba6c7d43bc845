#include "tools/calibrate/prior_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "predictor/tracking/calibration.h"
#include "predictor/tracking/calibration_prior.h"

namespace tern::calibrate {
namespace {

// θ is at least this share of the allowed miss rate.
constexpr double kMinLevelShare = 0.1;
// Each band may miss this share of the allowed rate even if earlier bands used all of it.
constexpr double kMinMissShare = 0.05;
constexpr int kHalvings = 20;  // of [0, 1], for θ

constexpr double kMotions = 3.0;  // steady, calm, lively
// Slow recordings know a class well if a source has at least this weight there.
constexpr double kMinKnownWeight = 0.5;

struct Prediction {
  const ScoredPrediction* scored;
  std::array<bool, kConfidenceLevels.size()> missed{};
};

// The predictions of one class from one source.
struct SourcePredictions {
  double weight;
  std::vector<Prediction> predictions;
};

// Those that were evaluated to the end of a band, by their scores there.
struct BandScores {
  double weight;
  std::vector<std::pair<double, Prediction*>> scores;  // ascending
};

std::vector<SourcePredictions> of_class(const std::vector<Source>& sources, std::size_t k) {
  const TrackAge age = kCalibratedClasses[k].of.age;
  std::vector<SourcePredictions> all;
  for (const Source& source : sources) {
    SourcePredictions own{source.weight, {}};
    double of_age = 0.0;
    for (const ScoredPrediction& scored : source.scored) {
      if (class_index(scored.of) == k) own.predictions.push_back({&scored});
      // Predictions of the learnt model come from a second tracker on the same recording.
      const bool is_of_bank = scored.of.motion != MotionKind::Learnt;
      of_age += is_of_bank && scored.of.age == age ? 1.0 : 0.0;
    }
    if (own.predictions.size() < kMinPredictions) continue;
    own.weight *= std::min(1.0, kMotions * static_cast<double>(own.predictions.size()) / of_age);
    all.push_back(std::move(own));
  }
  return all;
}

std::vector<BandScores> evaluated_to(std::vector<SourcePredictions>& all, std::size_t band) {
  std::vector<BandScores> bands;
  for (SourcePredictions& source : all) {
    BandScores own{source.weight, {}};
    for (Prediction& prediction : source.predictions) {
      if (prediction.scored->bands > band) own.scores.emplace_back(prediction.scored->scores[band], &prediction);
    }
    std::sort(own.scores.begin(), own.scores.end());
    if (!own.scores.empty()) bands.push_back(std::move(own));
  }
  return bands;
}

double quantile(const std::vector<BandScores>& sources, double p) {
  double largest = -kModelSigmas;
  for (const BandScores& source : sources) {
    const double own = 1.0 - (1.0 - p) / source.weight;
    if (own < 0.0) continue;
    const auto n = static_cast<double>(source.scores.size());
    const auto rank = static_cast<std::size_t>(std::min(n - 1.0, std::floor(own * n)));
    largest = std::max(largest, source.scores[rank].first);
  }
  return largest;
}

// The least margin with which a source misses at most the share `allowed`.
double margin_of(const BandScores& source, std::size_t level, double allowed) {
  const auto n = static_cast<double>(source.scores.size());
  double left = allowed * n;
  for (const auto& [score, prediction] : source.scores) left -= prediction->missed[level] ? 1.0 : 0.0;
  left = std::max(left, kMinMissShare * allowed * n);
  const auto last = std::find_if(source.scores.rbegin(), source.scores.rend(), [&](const auto& score) {
    left -= score.second->missed[level] ? 0.0 : 1.0;
    return left < 0.0;
  });
  return last == source.scores.rend() ? -kModelSigmas : last->first;
}

// Finds the margin of a band and marks the predictions that it misses. @return θ.
double level_of_band(std::vector<BandScores>& sources, std::size_t level, double allowed) {
  double margin = -kModelSigmas;
  for (const BandScores& source : sources) margin = std::max(margin, margin_of(source, level, allowed / source.weight));
  for (BandScores& source : sources) {
    for (auto& [score, prediction] : source.scores)
      prediction->missed[level] = prediction->missed[level] || score > margin;
  }
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double p = 0.5 * (low + high);
    (quantile(sources, p) < margin ? low : high) = p;
  }
  return std::clamp(1.0 - high, kMinLevelShare * allowed, allowed);
}

// The row of one class and band.
struct Row {
  std::vector<double> levels, quantiles;
  std::size_t predictions = 0;
};

using Rows = std::array<Row, kBands>;

Rows rows_of(std::vector<SourcePredictions>& all) {
  const Calibration calibration(kConfidenceLevels.front());
  Rows rows;
  for (std::size_t band = 0; band < kBands; ++band) {
    std::vector<BandScores> sources = evaluated_to(all, band);
    if (sources.empty()) {
      throw std::runtime_error(fmt::format(
          "no source has {} predictions of each class, evaluated to {} s: more logs are needed, or --made-up 100",
          kMinPredictions, kCoverageHorizons[band]));
    }
    Row& row = rows[band];
    for (const BandScores& source : sources) row.predictions += source.scores.size();
    for (std::size_t level = 0; level < kConfidenceLevels.size(); ++level) {
      row.levels.push_back(level_of_band(sources, level, calibration.allowed(level, band)));
    }
    for (const double p : kPriorProbabilities)
      row.quantiles.push_back(quantile(sources, std::min(p, kPriorLastProbability)));
  }
  return rows;
}

// The margin of level 0.
double margin_of(const Row& row) {
  const double p = 1.0 - row.levels.front();
  const auto next = std::find_if(kPriorProbabilities.begin() + 1, kPriorProbabilities.end() - 1,
                                 [p](double probability) { return probability >= p; });
  const auto k = idx(next - kPriorProbabilities.begin());
  return std::lerp(row.quantiles[k - 1], row.quantiles[k],
                   (p - kPriorProbabilities[k - 1]) / (kPriorProbabilities[k] - kPriorProbabilities[k - 1]));
}

// Slow scenes are among all scenes, so the margins of the first table hold there, too: the narrower ones are taken.
Rows narrower(const Rows& any, const Rows& slow) {
  Rows rows = slow;
  for (std::size_t band = 0; band < kBands; ++band) {
    if (margin_of(any[band]) < margin_of(slow[band])) rows[band] = any[band];
  }
  return rows;
}

std::string text_of(std::size_t k, const Rows& rows) {
  std::string text = fmt::format("    // class {}\n", k);
  for (std::size_t band = 0; band < kBands; ++band) {
    const auto& [levels, quantiles, predictions] = rows[band];
    text += fmt::format("    {{{{{:.4f}}}, {{{:.3f}}}}},  // to {} s, of {} predictions\n", fmt::join(levels, ", "),
                        fmt::join(quantiles, ", "), kCoverageHorizons[band], predictions);
  }
  return text;
}

}  // namespace

std::string prior_table(const std::vector<Source>& sources, const std::vector<Source>& slow_sources) {
  std::string any = "    // scenes of any speed\n", slow = "    // slow scenes\n";
  for (std::size_t k = 0; k < kClasses; ++k) {
    std::vector<SourcePredictions> all = of_class(sources, k), among_slow = of_class(slow_sources, k);
    const auto is_known = [](const SourcePredictions& source) { return source.weight >= kMinKnownWeight; };
    const bool is_slow_known = std::any_of(among_slow.begin(), among_slow.end(), is_known);
    const Rows rows = rows_of(all);
    any += text_of(k, rows);
    slow += text_of(k, is_slow_known ? narrower(rows, rows_of(among_slow)) : rows);
  }
  return any + slow;
}

}  // namespace tern::calibrate
