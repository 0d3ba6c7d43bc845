// The event log of LCM, as lcm-logger writes it and lcm-logplayer and lcm-spy read it.
//
// A file is a sequence of events, without header, index or checksums. An event, with big-endian integers:
//
//     u32 0xEDA1DA01 | i64 number | i64 time, µs | i32 channel bytes | i32 data bytes | channel | data
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tern {

inline constexpr std::uint32_t kLogSyncWord = 0xEDA1DA01;
inline constexpr std::size_t kLogHeadBytes = 28;
/// LCM_MAX_CHANNEL_NAME_LENGTH.
inline constexpr std::size_t kLogMaxChannelBytes = 63;
/// The largest data of an event that a reader accepts, 16 MiB, so a wrong length cannot exhaust the memory. (LCM's own
/// reader allocates any length.) Tern's messages have at most 60 kB.
inline constexpr std::size_t kLogMaxDataBytes = std::size_t{1} << 24U;

/// A message as it was received.
struct LogEvent {
  std::int64_t number = 0;       ///< number of the event, from 0, continued through the parts of a log
  std::int64_t received_us = 0;  ///< when it was received, µs since the Unix epoch
  std::string channel;           ///< 1 … kLogMaxChannelBytes bytes
  std::vector<std::uint8_t> data;
};

}  // namespace tern
