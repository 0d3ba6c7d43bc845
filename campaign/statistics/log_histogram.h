// A histogram with logarithmic bins: percentiles of the answers of a thousand flights, from files that can be merged.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "campaign/statistics/distribution.h"

namespace tern {

/// Counts positive numbers in bins [b^k, b^(k+1)) with b = kBinRatio. Count, sum, least and greatest number are exact.
/// A percentile is the geometric middle of its bin: within 1 % of the exact one. Adding and merging are associative but
/// for the rounding of the sum.
class LogHistogram {
 public:
  static constexpr double kBinRatio = 1.02;
  /// Smaller numbers, 0 included, are counted in the bin of this one.
  static constexpr double kMin = 1e-4;

  /// @pre x is finite and ≥ 0
  void add(double x);
  void merge(const LogHistogram& other);

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] Distribution describe() const;

  /// "count sum least greatest bin:count bin:count …"; "" for an empty histogram.
  [[nodiscard]] std::string to_text() const;
  /// Parses the text of to_text(). @return nullopt for other texts.
  static std::optional<LogHistogram> parse(std::string_view text);

  friend bool operator==(const LogHistogram&, const LogHistogram&) = default;

 private:
  [[nodiscard]] double percentile(int percent) const;

  std::map<int, std::int64_t> bins_;
  std::int64_t count_ = 0;
  double sum_ = 0.0, min_ = std::numeric_limits<double>::infinity(), max_ = 0.0;
};

}  // namespace tern
