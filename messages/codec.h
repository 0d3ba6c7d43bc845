// Bytes ↔ values: one pair per message, pure. A message is accepted only when every check passes; see DESIGN "Bad
// input".
#pragma once

#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "core/world/health.h"

namespace tern {

using Bytes = std::vector<std::uint8_t>;

/// The message's LCM encoding (fingerprint first). @throws std::invalid_argument when the value breaks its own contract
/// (a count beyond its limit, more than kMaxMessageBytes): a caller's bug.
template <class T>
Bytes encode(const T& value);

/// The value of exactly these bytes, or why they are refused. Checks, in this order: fingerprint; counts at their fixed
/// offsets within limits; length exactly as the counts ask (a trailer may follow: trailer.h, its tag is not checked
/// here); numbers finite and in range; enumerations known; times in
/// order; fields consistent. Never throws, allocates no more than the message's own size asks for.
template <class T>
tl::expected<T, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
