// Counts the received messages of each channel; the logger prints the counts when it ends.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "core/wire/header.h"
#include "core/wire/health.h"
#include "core/wire/message_losses.h"

namespace tern {

/// Decodes the header of a message that Tern sends on a channel. Refuses the messages that the channel's receivers
/// refuse.
using HeadDecoder = tl::expected<Header, Rejection> (*)(std::span<const std::uint8_t>);

/// The decoder of one of Tern's channels (messages/channels.h); nullptr for other channels.
/// @param channel  without a vehicle's suffix
HeadDecoder find_head_decoder(std::string_view channel);

/// Counts of one channel's messages.
struct ChannelCount {
  std::int64_t received = 0;  ///< all messages, refused ones included
  std::int64_t bytes = 0;
  std::int64_t refused = 0;  ///< not a valid message of this channel; 0 on channels that are not Tern's
  std::int64_t lost = 0;     ///< by the senders' sequence numbers (MessageLosses); 0 on channels that are not Tern's
};

/// Counts messages. A sender's first message begins its count, so joining late does not count as loss.
class ChannelTable {
 public:
  /// @param suffix  end of the vehicle's channel names, "" for none
  explicit ChannelTable(std::string suffix = "") : suffix_(std::move(suffix)) {}
  void add(std::string_view channel, UTime received, std::span<const std::uint8_t> data);
  [[nodiscard]] std::map<std::string, ChannelCount> counts() const;

 private:
  struct Entry {
    ChannelCount count;
    HeadDecoder decode = nullptr;
    MessageLosses losses;
  };
  std::string suffix_;
  std::map<std::string, Entry, std::less<>> channels_;
};

}  // namespace tern
