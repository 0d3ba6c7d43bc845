// PLAN on the wire: lcmtypes/plan_t.lcm.
#pragma once

#include "core/world/horizon.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const Plan& value);
/// Inconsistent: a certificate plane of an interval or part that the trajectory does not have, or whose normal is not
/// of length 1 (to 1e-6). Whether the trajectory is a good one is the executor's and the audit's to judge.
template <>
tl::expected<Plan, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
