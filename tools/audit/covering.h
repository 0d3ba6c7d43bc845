// Whether several prediction intervals cover a true box together.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/track.h"

namespace tern::audit {

/// Returns true if the union of the boxes contains `whole`: what is left of it after each box is cut away is empty.
/// Exact. O(boxes · pieces), where each box can cut a piece into six.
bool contain_together(const std::vector<Box>& boxes, const Box& whole);

/// Returns true if the intervals of a set's tracks, at time t and with α of a level, contain `whole` together.
/// @param tolerance  each interval is larger by this, m
bool intervals_contain(const TrackSet& set, UTime t, std::size_t level, const Box& whole, double tolerance);

}  // namespace tern::audit
