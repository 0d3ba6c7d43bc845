// The messages that wait to be sent to one client.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace tern::foxglove {

/// A message that waits to be sent; a text has no head.
struct WaitingMessage {
  std::string head;
  std::shared_ptr<const std::string> body;        ///< not null
  std::optional<std::uint32_t> latched_for = {};  ///< the subscription, if its channel is latched
  [[nodiscard]] std::size_t bytes() const { return head.size() + body->size(); }
};

/// A queue that is bounded although its client reads slowly or not at all. Pure.
///
/// | message                    | state                         | effect                                            |
/// |----------------------------|-------------------------------|---------------------------------------------------|
/// | of a latched channel       | one of its subscription waits | takes its place: the older one is dropped         |
/// | of a latched channel       | else                          | waits, and is never dropped for other messages    |
/// | of other channels, a text  | more than `most_bytes` wait   | the oldest of these are dropped; the newest stays |
///
/// A latched message comes once, as a map does, so its loss would last. Memory: `most_bytes` or one larger message, and
/// a latched message per subscription; subscriptions of one channel share the body.
class WaitingMessages {
 public:
  /// @param most_bytes  of the messages that are not latched
  explicit WaitingMessages(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Adds a message at the end, or in the place of the one that it replaces. @return how many messages were dropped
  std::int64_t add(WaitingMessage message);
  /// Removes the latched message of a subscription that has ended.
  void end(std::uint32_t subscription);
  /// Removes the first message and returns it; nullopt if none waits.
  std::optional<WaitingMessage> take();

 private:
  [[nodiscard]] std::deque<WaitingMessage>::iterator latched(std::uint32_t subscription);

  std::size_t most_bytes_;
  std::deque<WaitingMessage> messages_;
  std::size_t bytes_ = 0;  ///< of the messages that are not latched
  std::size_t count_ = 0;  ///< of the messages that are not latched
};

}  // namespace tern::foxglove
