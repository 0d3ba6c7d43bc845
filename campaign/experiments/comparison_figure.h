// Two campaigns over the same seeds, as a drawing.
#pragma once

#include <string>

#include "campaign/records/campaign_comparison.h"

namespace tern {

/// Written here, not by docs/results/figures.py, because `tern-campaign compare` is installed and that script is not.
/// SVG: a row per measure in which a pair differs, its difference B − A as a share of A's mean. It has its 95 %
/// interval where one may be inferred (CampaignComparison::may_infer). A measure whose mean is 0 in A has a hollow mark
/// at the frame's edge, on the side of B, and its interval in numbers.
std::string draw_comparison(const CampaignComparison& comparison);

}  // namespace tern
