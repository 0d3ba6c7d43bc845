// HEARTBEAT on the wire: lcmtypes/heartbeat_t.lcm.
#pragma once

#include "core/world/health.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const Heartbeat& value);
/// Inconsistent: name lengths that do not sum to the names' bytes, channels or echoes that are not in ascending order.
template <>
tl::expected<Heartbeat, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
