#include "campaign/statistics/paired.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr int kResamples = 2000;

/// Means of resampled numbers, ascending.
std::vector<double> resampled_means(const std::vector<double>& numbers) {
  Rng rng(numbers.size());
  const auto n = static_cast<double>(numbers.size());
  std::vector<double> means;
  means.reserve(kResamples);
  for (int k = 0; k < kResamples; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) sum += numbers[static_cast<std::size_t>(rng.uniform() * n)];
    means.push_back(sum / n);
  }
  std::sort(means.begin(), means.end());
  return means;
}

}  // namespace

PairedDifference paired_difference(const std::vector<std::pair<double, double>>& pairs) {
  PairedDifference d;
  d.interval = {0.0, 0.0};
  d.pairs = static_cast<std::int64_t>(pairs.size());
  if (pairs.empty()) return d;
  std::vector<double> differences;
  for (const auto& [a, b] : pairs) {
    d.mean_a += a / static_cast<double>(d.pairs);
    d.mean_b += b / static_cast<double>(d.pairs);
    d.difference += (b - a) / static_cast<double>(d.pairs);
    d.different += a != b ? 1 : 0;
    differences.push_back(b - a);
  }
  if (d.different == 0) return d;
  const std::vector<double> means = resampled_means(differences);
  constexpr std::size_t kTail = kResamples * 25 / 1000;
  d.interval = {means[kTail], means[kResamples - 1 - kTail]};
  return d;
}

double mcnemar(std::int64_t a_alone, std::int64_t b_alone) {
  if (a_alone < 0 || b_alone < 0) throw std::invalid_argument("mcnemar: a negative count");
  const auto n = static_cast<double>(a_alone + b_alone);
  double tail = 0.0;
  for (std::int64_t k = 0; k <= std::min(a_alone, b_alone); ++k) {
    const auto x = static_cast<double>(k);
    tail += std::exp(std::lgamma(n + 1) - std::lgamma(x + 1) - std::lgamma(n - x + 1) - n * std::log(2.0));
  }
  return std::min(1.0, 2.0 * tail);
}

}  // namespace tern
