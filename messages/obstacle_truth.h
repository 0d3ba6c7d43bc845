// OBSTACLE_TRUTH on the wire: lcmtypes/obstacle_truth_t.lcm.
#pragma once

#include "core/world/observation.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const ObstacleTruth& value);
/// Inconsistent: two obstacles with one id.
template <>
tl::expected<ObstacleTruth, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
