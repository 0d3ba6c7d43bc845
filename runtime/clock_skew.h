// How far another process's clock is from this one's, by the messages that it sends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

#include "core/base/time.h"

namespace tern {

/// One sender's clock against the listener's. Pure.
///
/// A message that took the time d > 0 says: sent − received = skew − d. So the largest difference of the newest kWindow
/// messages is the best bound from below; it falls short of the skew by the shortest way of them: some 0.1 ms on one
/// host, under 1 ms on a cable. A clock that is set while the sender runs is believed after kWindow messages at most.
class ClockSkew {
 public:
  static constexpr std::size_t kWindow = 6;  ///< three seconds of heartbeats

  /// @param sent  header.utime, the sender's clock   @param received  Bus::received(), the listener's
  void add(UTime sent, UTime received) {
    differences_.push_back(sent - received);
    if (differences_.size() > kWindow) differences_.pop_front();
  }
  /// How far the sender's clock is ahead of the listener's (negative: behind); nothing before the first message.
  [[nodiscard]] std::optional<Duration> ahead() const {
    if (differences_.empty()) return std::nullopt;
    return *std::max_element(differences_.begin(), differences_.end());
  }

 private:
  std::deque<Duration> differences_;
};

}  // namespace tern
