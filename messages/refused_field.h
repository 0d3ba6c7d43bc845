// Reasons for refusals: which field of a message a receiver refuses, and how many elements it leaves out.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace tern {

/// Returns the field for which decode<T>() refuses a message or leaves an element out, "control_points[3].x is nan", or
/// the rule between fields that the message breaks. Empty if decode() accepts the whole message, or refuses its form.
/// Also empty if the field has no name.
template <class T>
std::string refused_field(std::span<const std::uint8_t> bytes);

/// Returns how many elements of a message decode<T>() leaves out, while it accepts the others. Only an ObservationSet
/// may lose some: its detections whose position is refused (docs/decisions/parts-of-messages.md).
template <class T>
std::int32_t left_out_elements(std::span<const std::uint8_t> bytes);

}  // namespace tern
