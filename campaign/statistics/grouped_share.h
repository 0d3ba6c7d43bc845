// Bounds of a share whose items come in groups, without assumptions about dependence within a group.
#pragma once

#include <vector>

#include "campaign/statistics/wilson.h"

namespace tern {

/// One group: `some` of its `all` items have the property.
struct GroupShare {
  double all = 0.0, some = 0.0;  ///< 0 ≤ some ≤ all, all > 0
};

/// Returns a lower bound of the share Σ some/Σ all in the population of groups. The true share is smaller with
/// probability `error` at most. 0 without groups, or if no item has the property.
///
/// By betting (I. Waudby-Smith, A. Ramdas, "Estimating means of bounded random variables by betting", JRSS B 2024). Let
/// x be a group's share and w = all/(largest all). For a true share of s or less, each wealth ∏ (1 + θ w (x/s − 1))
/// has an expectation of at most 1. The same holds for its mean over the stakes θ in [0, 1], which therefore exceeds
/// 1/error with probability `error` at most. The bound is the least s that is not refuted in this way, to 1e-7.
/// O(n) for each of some 25 halvings. @pre groups are independent of each other; 0 < error < 1
double share_lower_bound(const std::vector<GroupShare>& groups, double error);

/// Returns the upper bound: 1 − share_lower_bound() of the items without the property.
double share_upper_bound(std::vector<GroupShare> groups, double error);

/// Returns both bounds, each at half of `error`.
Interval share_interval(const std::vector<GroupShare>& groups, double error = 0.05);

}  // namespace tern
