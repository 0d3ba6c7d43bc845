// What a sender with a key appends behind a message: who says it, which message it is, when, and a tag over all of it.
//
// 48 bytes, integers big-endian as LCM writes them:
//   "TMAC" | u8 1 (version) | u8 role | u16 0 | i64 sender_epoch_us | i64 sequence | i64 utime_us | 16 bytes of tag
// Generated decoders ignore what follows a message. The counts tell decode() where a message ends; beyond must be
// nothing, or exactly one trailer. It does not check the tag; runtime/authentication.h does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/world/header.h"
#include "messages/codec.h"

namespace tern {

inline constexpr std::size_t kTagBytes = 16;
inline constexpr std::size_t kTrailerHeadBytes = 32;  ///< all but the tag
inline constexpr std::size_t kTrailerBytes = kTrailerHeadBytes + kTagBytes;
using Tag = std::array<std::uint8_t, kTagBytes>;

struct Trailer {
  std::uint8_t role = 0;  ///< as Role (channels.h)
  MessageName name;       ///< as in the message's header
  UTime utime;            ///< as in the message's header
  Tag tag = {};
};

/// @return the trailer that these bytes end with, or nullopt if there is none, or one of another version. Bytes that
/// are no trailer look like one with a probability of 2⁻⁶⁴.
std::optional<Trailer> read_trailer(std::span<const std::uint8_t> bytes);

/// Appends all but the tag, which is then made over what is there, and appended by the caller.
void append_trailer_head(Bytes& bytes, const Trailer& trailer);

}  // namespace tern
