#include "campaign/statistics/log_histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/base/percentiles.h"

namespace tern {
namespace {

int bin_of(double x) {
  return static_cast<int>(std::floor(std::log(std::max(x, LogHistogram::kMin)) / std::log(LogHistogram::kBinRatio)));
}

}  // namespace

void LogHistogram::add(double x) {
  if (!std::isfinite(x) || x < 0.0) throw std::invalid_argument(fmt::format("LogHistogram: {} is not counted", x));
  ++bins_[bin_of(x)];
  ++count_;
  sum_ += x;
  min_ = std::min(min_, x);
  max_ = std::max(max_, x);
}

void LogHistogram::merge(const LogHistogram& other) {
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
  count_ += other.count_;
  sum_ += other.sum_;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
}

double LogHistogram::percentile(int percent) const {
  const auto rank =
      static_cast<std::int64_t>(nearest_rank(static_cast<std::size_t>(count_), static_cast<std::size_t>(percent)));
  std::int64_t passed = 0;
  for (const auto& [bin, count] : bins_) {
    passed += count;
    if (passed > rank) return std::clamp(std::pow(kBinRatio, bin + 0.5), min_, max_);
  }
  return max_;
}

Distribution LogHistogram::describe() const {
  if (count_ == 0) return {};
  return {count_, sum_ / static_cast<double>(count_), percentile(50), percentile(95), percentile(99), min_, max_};
}

std::string LogHistogram::to_text() const {
  if (count_ == 0) return "";
  std::string text = fmt::format("{} {} {} {}", count_, sum_, min_, max_);
  for (const auto& [bin, count] : bins_) text += fmt::format(" {}:{}", bin, count);
  return text;
}

std::optional<LogHistogram> LogHistogram::parse(std::string_view text) {
  LogHistogram histogram;
  if (text.empty()) return histogram;
  std::istringstream in{std::string(text)};
  in.imbue(std::locale::classic());
  if (!(in >> histogram.count_ >> histogram.sum_ >> histogram.min_ >> histogram.max_)) return std::nullopt;
  std::int64_t total = 0;
  for (std::string entry; in >> entry;) {
    std::istringstream pair(entry);
    int bin = 0;
    char colon = 0;
    std::int64_t count = 0;
    if (!(pair >> bin >> colon >> count) || colon != ':' || count <= 0 || !pair.eof()) return std::nullopt;
    histogram.bins_[bin] += count;
    total += count;
  }
  if (total != histogram.count_ || total == 0) return std::nullopt;
  return histogram;
}

}  // namespace tern
