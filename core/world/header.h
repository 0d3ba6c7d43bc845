// Who sent a message, which one it is, and when: names survive restarts because a sender's epoch changes with each
// start.
#pragma once

#include <compare>
#include <cstdint>

#include "core/base/time.h"

namespace tern {

/// The name of a message on its channel: the sender's start time and a counter from 1. {0, 0}: none.
struct MessageName {
  std::int64_t sender_epoch_us = 0;  ///< when the sending process started, µs since the Unix epoch
  std::int64_t sequence = 0;         ///< counts this sender's messages on this channel, from 1; 0: no message
  friend constexpr auto operator<=>(const MessageName&, const MessageName&) = default;
};

/// The head of every message. The bus fills it in when it publishes.
struct Header {
  MessageName name;
  UTime utime;  ///< when it was published, the sender's clock
};

/// A part of a set that is sent as numbered batches; only complete sets are used.
struct BatchHeader {
  std::int64_t set = 0;    ///< counts the sender's sets, from 1
  std::int32_t index = 0;  ///< 0 … count − 1
  std::int32_t count = 1;  ///< batches in this set, 1 … kMaxBatches
};
inline constexpr int kMaxBatches = 6;
/// No message is longer than this, bytes: beyond it LCM fragments and sends unpaced.
inline constexpr int kMaxMessageBytes = 60'000;

}  // namespace tern
