// OBSTACLE_OBSERVATIONS on the wire: lcmtypes/observation_set_t.lcm.
#pragma once

#include "core/world/observation.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const ObservationSet& value);
/// Inconsistent: two detections with one track id.
template <>
tl::expected<ObservationSet, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
