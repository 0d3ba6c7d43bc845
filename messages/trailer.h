// The trailer that a sender with a key appends to a message: role, name, time, and a tag over message and trailer.
//
// It has 48 bytes; integers are big-endian, as in LCM:
//
//     "TMAC" | u8 1 (version) | u8 role | u16 0 | i64 sender_epoch_us | i64 sequence | i64 utime_us | 16 bytes of tag
//
// Generated LCM decoders ignore bytes after a message. decode() knows the end of a message from its counts; it accepts
// no further bytes, or exactly one trailer. runtime/authentication.h checks the tag.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/wire/header.h"
#include "messages/codec.h"

namespace tern {

inline constexpr std::size_t kTagBytes = 16;
inline constexpr std::size_t kTrailerHeadBytes = 32;  ///< without the tag
inline constexpr std::size_t kTrailerBytes = kTrailerHeadBytes + kTagBytes;
using Tag = std::array<std::uint8_t, kTagBytes>;

/// The content of a trailer.
struct Trailer {
  std::uint8_t role = 0;  ///< a Role (channels.h)
  MessageName name;       ///< as in the message's header
  UTime utime;            ///< as in the message's header
  Tag tag = {};
};

/// Returns the trailer at the end of `bytes`, or nullopt if there is none or it has another version. Random bytes look
/// like a trailer with a probability of 2⁻⁶⁴.
std::optional<Trailer> read_trailer(std::span<const std::uint8_t> bytes);

/// Appends the trailer without its tag. The caller computes the tag over all bytes and appends it.
void append_trailer_head(Bytes& bytes, const Trailer& trailer);

}  // namespace tern
