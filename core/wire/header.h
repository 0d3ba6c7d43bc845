// The head of a message: its name and its time. A name is unique across restarts, because a sender has a new epoch
// after each start.
#pragma once

#include <compare>
#include <cstdint>

#include "core/base/time.h"

namespace tern {

/// The name of a message on its channel: the sender's start time and a counter. {0, 0} names no message.
struct MessageName {
  std::int64_t sender_epoch_us = 0;  ///< when the sending process started, µs since the Unix epoch
  std::int64_t sequence = 0;         ///< number of the message, from 1, per sender and channel; 0: no message
  friend constexpr auto operator<=>(const MessageName&, const MessageName&) = default;
};

/// The head of every message. The bus fills it in when it publishes the message.
struct Header {
  MessageName name;
  UTime utime;  ///< when it was published, by the sender's clock
};

/// The place of a batch in its set. A set is sent as numbered batches; receivers use complete sets only.
struct BatchHeader {
  std::int64_t set = 0;    ///< number of the set, from 1, per sender
  std::int32_t index = 0;  ///< 0 … count − 1
  std::int32_t count = 1;  ///< batches in this set, 1 … kMaxBatches
};
inline constexpr int kMaxBatches = 6;
/// The largest message, bytes. LCM would split larger ones and send the fragments without a pause.
inline constexpr int kMaxMessageBytes = 60'000;

}  // namespace tern
