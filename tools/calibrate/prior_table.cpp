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

// θ is at least this share of what is allowed.
constexpr double kLeastShare = 0.1;
// Of what is allowed, the share that each band may break even if those before it broke all that is allowed.
constexpr double kLeastBroken = 0.05;
constexpr int kHalvings = 20;  // of [0, 1], for θ

constexpr double kKinds = 3.0;  // of motion: steady, calm, lively
// A class is known where a source counts so much there.
constexpr double kWeightOfAKind = 0.5;

struct Promise {
  const Judged* judged;
  std::array<bool, kConfidenceLevels.size()> broken{};
};

// The promises of a class that one source made.
struct OfSource {
  double weight;
  std::vector<Promise> promises;
};

// Those of a source that were seen to the end of a band, by their scores there.
struct Band {
  double weight;
  std::vector<std::pair<double, Promise*>> scores;  // ascending
};

// How long tracks of a class have been seen: New, Young, grown, old.
std::size_t age_of(TrackClass kind) {
  const auto k = idx(kind);
  if (kind == TrackClass::Learnt) return 3;
  return k < 2 ? k : 2 + k % 2;
}

std::vector<OfSource> of_class(const std::vector<Source>& sources, TrackClass kind) {
  std::vector<OfSource> all;
  for (const Source& source : sources) {
    OfSource own{source.weight, {}};
    double of_age = 0.0;
    for (const Judged& judged : source.judged) {
      if (judged.kind == kind) own.promises.push_back({&judged});
      const bool is_given = judged.kind != TrackClass::Learnt;  // else it is a second promise of the same
      of_age += is_given && age_of(judged.kind) == age_of(kind) ? 1.0 : 0.0;
    }
    if (own.promises.size() < kFewPromises) continue;
    own.weight *= std::min(1.0, kKinds * static_cast<double>(own.promises.size()) / of_age);
    all.push_back(std::move(own));
  }
  return all;
}

std::vector<Band> seen_to(std::vector<OfSource>& all, std::size_t band) {
  std::vector<Band> bands;
  for (OfSource& source : all) {
    Band own{source.weight, {}};
    for (Promise& promise : source.promises) {
      if (promise.judged->bands > band) own.scores.emplace_back(promise.judged->scores[band], &promise);
    }
    std::sort(own.scores.begin(), own.scores.end());
    if (!own.scores.empty()) bands.push_back(std::move(own));
  }
  return bands;
}

double quantile(const std::vector<Band>& sources, double p) {
  double largest = -kModelSigmas;
  for (const Band& source : sources) {
    const double own = 1.0 - (1.0 - p) / source.weight;
    if (own < 0.0) continue;
    const auto n = static_cast<double>(source.scores.size());
    const auto rank = static_cast<std::size_t>(std::min(n - 1.0, std::floor(own * n)));
    largest = std::max(largest, source.scores[rank].first);
  }
  return largest;
}

// The least margin beyond which a source breaks no more than the share `allowed`.
double margin_of(const Band& source, std::size_t level, double allowed) {
  const auto n = static_cast<double>(source.scores.size());
  double left = allowed * n;
  for (const auto& [score, promise] : source.scores) left -= promise->broken[level] ? 1.0 : 0.0;
  left = std::max(left, kLeastBroken * allowed * n);
  const auto last = std::find_if(source.scores.rbegin(), source.scores.rend(), [&](const auto& score) {
    left -= score.second->broken[level] ? 0.0 : 1.0;
    return left < 0.0;
  });
  return last == source.scores.rend() ? -kModelSigmas : last->first;
}

// Breaks what is beyond the band's margin. @return θ.
double break_band(std::vector<Band>& sources, std::size_t level, double allowed) {
  double margin = -kModelSigmas;
  for (const Band& source : sources) margin = std::max(margin, margin_of(source, level, allowed / source.weight));
  for (Band& source : sources) {
    for (auto& [score, promise] : source.scores) promise->broken[level] = promise->broken[level] || score > margin;
  }
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double p = 0.5 * (low + high);
    (quantile(sources, p) < margin ? low : high) = p;
  }
  return std::clamp(1.0 - high, kLeastShare * allowed, allowed);
}

// What the table holds of one class and band.
struct Row {
  std::vector<double> levels, quantiles;
  std::size_t promises = 0;
};

using Rows = std::array<Row, kBands>;

Rows rows_of(std::vector<OfSource>& all) {
  const Calibration calibration(kConfidenceLevels.front());
  Rows rows;
  for (std::size_t band = 0; band < kBands; ++band) {
    std::vector<Band> sources = seen_to(all, band);
    if (sources.empty()) {
      throw std::runtime_error(
          fmt::format("no source has {} promises of each class, seen to {} s", kFewPromises, kBandEnds[band]));
    }
    Row& row = rows[band];
    for (const Band& source : sources) row.promises += source.scores.size();
    for (std::size_t level = 0; level < kConfidenceLevels.size(); ++level) {
      row.levels.push_back(break_band(sources, level, calibration.allowed(level, band)));
    }
    for (const double p : kPriorProbabilities) row.quantiles.push_back(quantile(sources, std::min(p, kPriorLast)));
  }
  return rows;
}

// At level 0.
double margin_of(const Row& row) {
  const double p = 1.0 - row.levels.front();
  const auto next = std::find_if(kPriorProbabilities.begin() + 1, kPriorProbabilities.end() - 1,
                                 [p](double probability) { return probability >= p; });
  const auto k = idx(next - kPriorProbabilities.begin());
  return std::lerp(row.quantiles[k - 1], row.quantiles[k],
                   (p - kPriorProbabilities[k - 1]) / (kPriorProbabilities[k] - kPriorProbabilities[k - 1]));
}

// A slow world is one of any pace: what is promised there holds in it too.
Rows narrower(const Rows& any, const Rows& slow) {
  Rows rows = slow;
  for (std::size_t band = 0; band < kBands; ++band) {
    if (margin_of(any[band]) < margin_of(slow[band])) rows[band] = any[band];
  }
  return rows;
}

std::string text_of(std::size_t kind, const Rows& rows) {
  std::string text = fmt::format("    // class {}\n", kind);
  for (std::size_t band = 0; band < kBands; ++band) {
    const auto& [levels, quantiles, promises] = rows[band];
    text += fmt::format("    {{{{{:.4f}}}, {{{:.3f}}}}},  // to {} s, of {} promises\n", fmt::join(levels, ", "),
                        fmt::join(quantiles, ", "), kBandEnds[band], promises);
  }
  return text;
}

}  // namespace

std::string prior_table(const std::vector<Source>& sources, const std::vector<Source>& slow_sources) {
  std::string any = "    // worlds of any pace\n", slow = "    // slow worlds\n";
  for (std::size_t kind = 0; kind < kTrackClasses; ++kind) {
    std::vector<OfSource> all = of_class(sources, static_cast<TrackClass>(kind)),
                          among_slow = of_class(slow_sources, static_cast<TrackClass>(kind));
    const auto is_known = [](const OfSource& source) { return source.weight >= kWeightOfAKind; };
    const bool is_slow_known = std::any_of(among_slow.begin(), among_slow.end(), is_known);
    const Rows rows = rows_of(all);
    any += text_of(kind, rows);
    slow += text_of(kind, is_slow_known ? narrower(rows, rows_of(among_slow)) : rows);
  }
  return any + slow;
}

}  // namespace tern::calibrate
