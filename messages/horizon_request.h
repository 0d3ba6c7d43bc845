// HORIZON_REQUEST on the wire: lcmtypes/horizon_request_t.lcm.
#pragma once

#include "core/world/horizon.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const HorizonRequest& value);
/// Time: t_s before the committed trajectory, a deadline later than t_s − kDeadlineLead. Inconsistent: a committed
/// trajectory that does not end at rest, a start that is not its state at t_s (to kJoinTolerance), an empty flight box.
template <>
tl::expected<HorizonRequest, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
