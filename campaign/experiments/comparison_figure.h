// Two campaigns over the same seeds, as a drawing.
#pragma once

#include <string>

#include "campaign/records/campaign_comparison.h"

namespace tern {

/// SVG: a row per measure in which a pair differs, its difference B − A as a share of A's mean, with its 95 % interval
/// where one may be inferred (CampaignComparison::may_infer). Measures whose mean is 0 in A have their numbers only.
std::string draw_comparison(const CampaignComparison& comparison);

}  // namespace tern
