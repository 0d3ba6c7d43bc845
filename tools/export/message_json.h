// Converts an encoded message to JSON, with names and order of its definition in lcmtypes/.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

namespace tern::exporting {

using Json = nlohmann::ordered_json;

/// Converts a message that decode() (messages/codec.h) accepts. Texts become strings, digests "0x" with 16 digits,
/// booleans true or false, and enumerations numbers. Infinite values and NaN remain in the value; printed JSON has
/// null.
/// @throws std::out_of_range if the type is unknown, or the bytes are too few for its fields
Json message_json(std::string_view type, std::span<const std::uint8_t> bytes);

}  // namespace tern::exporting
