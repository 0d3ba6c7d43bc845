// CONFIGURATION on the wire: lcmtypes/configuration_t.lcm.
#pragma once

#include "core/world/health.h"
#include "messages/codec.h"

namespace tern {

template <>
Bytes encode(const ConfigurationReport& value);
/// Inconsistent: a hash that is not digest(yaml).
template <>
tl::expected<ConfigurationReport, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
