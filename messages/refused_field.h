// Why a message is refused, in words.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace tern {

/// Returns the field for which decode<T>() refuses a message, with its value: "control_points[3].x is nan"; or the rule
/// between fields that the message breaks. Empty if decode() accepts it, or refuses its form, or the field has no name.
template <class T>
std::string refused_field(std::span<const std::uint8_t> bytes);

}  // namespace tern
