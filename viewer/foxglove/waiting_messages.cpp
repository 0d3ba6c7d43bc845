#include "viewer/foxglove/waiting_messages.h"

#include <algorithm>
#include <utility>

namespace tern::foxglove {

std::deque<WaitingMessage>::iterator WaitingMessages::latched(std::uint32_t subscription) {
  return std::find_if(messages_.begin(), messages_.end(),
                      [subscription](const WaitingMessage& waiting) { return waiting.latched_for == subscription; });
}

std::int64_t WaitingMessages::add(WaitingMessage message) {
  if (message.latched_for) {
    const auto older = latched(*message.latched_for);
    const bool replaces = older != messages_.end();
    if (replaces) {
      *older = std::move(message);
    } else {
      messages_.push_back(std::move(message));
    }
    return replaces ? 1 : 0;
  }
  bytes_ += message.bytes();
  ++count_;
  messages_.push_back(std::move(message));
  std::int64_t dropped = 0;
  for (; bytes_ > most_bytes_ && count_ > 1; ++dropped) {
    const auto oldest = std::find_if(messages_.begin(), messages_.end(),
                                     [](const WaitingMessage& waiting) { return !waiting.latched_for; });
    bytes_ -= oldest->bytes();
    --count_;
    messages_.erase(oldest);
  }
  return dropped;
}

void WaitingMessages::end(std::uint32_t subscription) {
  const auto found = latched(subscription);
  if (found != messages_.end()) messages_.erase(found);
}

std::optional<WaitingMessage> WaitingMessages::take() {
  if (messages_.empty()) return std::nullopt;
  WaitingMessage first = std::move(messages_.front());
  messages_.pop_front();
  if (!first.latched_for) {
    bytes_ -= first.bytes();
    --count_;
  }
  return first;
}

}  // namespace tern::foxglove
