#include "campaign/statistics/grouped_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tern {
namespace {

// Small stakes win most if the share is hardly exceeded, large ones if all groups exceed it.
constexpr std::array kStakes{1.0 / 512, 1.0 / 256, 1.0 / 128, 1.0 / 64, 1.0 / 32,    1.0 / 16,    1.0 / 8,
                             1.0 / 4,   1.0 / 2,   3.0 / 4,   7.0 / 8,  15.0 / 16.0, 31.0 / 32.0, 1.0};
constexpr int kHalvings = 25;

// Logarithm of the mean wealth over all stakes, for bets that the share is larger than s. It falls with s.
double log_wealth(const std::vector<GroupShare>& groups, double largest, double s) {
  std::array<double, kStakes.size()> logs{};
  for (const GroupShare& group : groups) {
    const double weight = group.all / largest, gain = group.some / group.all / s - 1.0;
    for (std::size_t k = 0; k < logs.size(); ++k) logs[k] += std::log1p(kStakes[k] * weight * gain);
  }
  const double most = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(most)) return most;
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - most);
  return most + std::log(sum / static_cast<double>(logs.size()));
}

}  // namespace

double share_lower_bound(const std::vector<GroupShare>& groups, double error) {
  double largest = 0.0;
  bool any = false;
  for (const GroupShare& group : groups) {
    largest = std::max(largest, group.all);
    any = any || group.some > 0.0;
  }
  if (!any) return 0.0;
  const double refuted = -std::log(error);
  double low = 0.0, high = 1.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (log_wealth(groups, largest, middle) >= refuted ? low : high) = middle;
  }
  return low;
}

double share_upper_bound(std::vector<GroupShare> groups, double error) {
  for (GroupShare& group : groups) group.some = group.all - group.some;
  return 1.0 - share_lower_bound(groups, error);
}

Interval share_interval(const std::vector<GroupShare>& groups, double error) {
  return {share_lower_bound(groups, 0.5 * error), share_upper_bound(groups, 0.5 * error)};
}

}  // namespace tern
