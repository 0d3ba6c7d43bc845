// A share of things that come in groups, within which anything may depend on anything: between proven bounds.
#pragma once

#include <vector>

#include "campaign/statistics/wilson.h"

namespace tern {

/// Of `all` things of a group, `some` have what is counted.
struct GroupShare {
  double all = 0.0, some = 0.0;  ///< 0 ≤ some ≤ all, all > 0
};

/// The lower end of a one-sided interval of the share Σ some/Σ all of the groups' population. The true one is smaller
/// with probability `error` at most. 0 without groups, or where none has anything.
///
/// By betting (I. Waudby-Smith, A. Ramdas, "Estimating means of bounded random variables by betting", JRSS B 2024): let
/// x be a group's share and w = all/(largest all). Were the share s or less, each wealth ∏ (1 + θ w (x/s − 1)) would
/// have an expectation of at most 1. So would its mean over the stakes θ in [0, 1], which then exceeds 1/error with
/// probability `error` at most. The end is the least s that is not refuted so. Groups are taken for independent of each
/// other; within a group nothing is assumed. To 1e-7. O(n) for each of some 25 halvings. @pre 0 < error < 1
double least_share(const std::vector<GroupShare>& groups, double error);

/// The upper end likewise: 1 − least_share() of the rest.
double greatest_share(std::vector<GroupShare> groups, double error);

/// Both ends, each at half of `error`.
Interval share_interval(const std::vector<GroupShare>& groups, double error = 0.05);

}  // namespace tern
