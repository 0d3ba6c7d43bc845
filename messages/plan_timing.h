// PLAN_TIMING on the wire: lcmtypes/plan_timing_t.lcm.
#pragma once

#include "core/world/horizon.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const PlanTiming& value);
template <>
tl::expected<PlanTiming, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
