// Compares two treatments of the same cases.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "campaign/statistics/wilson.h"

namespace tern {

/// The mean of b − a over pairs (a, b), with a 95 % percentile bootstrap interval (Efron and Tibshirani 1993, §13.3).
struct PairedDifference {
  std::int64_t pairs = 0, different = 0;  ///< all pairs, and those with a ≠ b
  double mean_a = 0.0, mean_b = 0.0;
  double difference = 0.0;
  Interval interval;  ///< of the difference; both ends are 0 if no pair differs
  /// False for fewer than six pairs. Five differences of one sign are not significant at 5 %: 2 · 2^−5 > 0.05.
  [[nodiscard]] bool may_infer() const { return pairs >= 6; }
};

/// Uses 2000 resamples of whole pairs, the same ones for equal numbers of pairs. O(2000 n). @pre all are finite
PairedDifference paired_difference(const std::vector<std::pair<double, double>>& pairs);

/// McNemar's exact test of two success rates over the same cases. It looks at the pairs in which exactly one
/// treatment succeeds. Returns the two-sided binomial probability, at rate 1/2, of a split at least as uneven as
/// theirs. 1 without such pairs.
double mcnemar(std::int64_t a_alone, std::int64_t b_alone);

}  // namespace tern
