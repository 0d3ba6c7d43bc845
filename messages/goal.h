// GOAL on the wire: lcmtypes/goal_t.lcm.
#pragma once

#include "core/world/goal.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const Goal& value);
template <>
tl::expected<Goal, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
