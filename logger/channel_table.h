// What came in, channel by channel: the logger's last word.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "core/world/header.h"
#include "core/world/health.h"
#include "core/world/message_losses.h"

namespace tern {

/// Reads the head of the message that Tern sends on a channel; refuses what the channel's receivers would refuse.
using HeadDecoder = tl::expected<Header, Rejection> (*)(std::span<const std::uint8_t>);

/// The decoder of one of Tern's channels (messages/channels.h); nullptr for a channel that is not Tern's.
/// @param channel  without a vehicle's suffix
HeadDecoder find_head_decoder(std::string_view channel);

/// A channel's messages as the logger saw them.
struct ChannelCount {
  std::int64_t received = 0;  ///< all, refused ones too
  std::int64_t bytes = 0;
  std::int64_t refused = 0;  ///< not what Tern sends on this channel; 0 on channels that are not Tern's
  std::int64_t lost = 0;     ///< by its senders' numbers (MessageLosses); 0 on channels that are not Tern's
};

/// Counts messages. The first message heard of a sender begins its count, so a late joiner has lost nothing.
class ChannelTable {
 public:
  /// @param suffix  what the vehicle's channels end with, "" for none
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
