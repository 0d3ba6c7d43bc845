// FLIGHT_RESULT on the wire: lcmtypes/flight_result_t.lcm.
#pragma once

#include "core/world/flight_result.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const FlightResult& value);
/// Inconsistent: name lengths that do not sum to the names' bytes. The seven measures may be NaN.
template <>
tl::expected<FlightResult, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
