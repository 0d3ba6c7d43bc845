// UAV_STATE and SETPOINT on the wire: lcmtypes/uav_state_t.lcm.
#pragma once

#include "core/world/vehicle.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const UavState& value);
template <>
tl::expected<UavState, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
