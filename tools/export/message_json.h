// A message as JSON, named and ordered as its definition in lcmtypes/ is.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "tools/export/message_types.h"

namespace tern::exporting {

using Json = nlohmann::ordered_json;

/// The fields of a message that decode() (messages/codec.h) accepts. Texts are strings, digests "0x" and 16 digits,
/// booleans true or false, enumerations numbers. Numbers that are not finite stay so; text that is made of them says
/// null.
/// @throws std::out_of_range when there is no such type, or the bytes are fewer than its fields take
Json message_json(std::string_view type, std::span<const std::uint8_t> bytes);

}  // namespace tern::exporting
