// Draws the comparison of two campaigns over the same seeds.
#pragma once

#include <string>

#include "campaign/records/campaign_comparison.h"

namespace tern {

/// Returns an SVG with a row per measure that differs in any pair: the difference B − A as a share of A's mean.
///
/// A row has a 95 % interval if one may be inferred (CampaignComparison::may_infer). If A's mean is 0, the row has a
/// hollow mark at the frame's edge, on the side of B, and its interval in numbers.
///
/// It is C++ because `tern-campaign compare` is installed, and docs/results/figures.py is not.
std::string draw_comparison(const CampaignComparison& comparison);

}  // namespace tern
