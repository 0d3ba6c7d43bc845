// Estimates the difference between the clocks of two processes, and the round trip between them. Heartbeats carry
// echoes of received heartbeats for it (RFC 5905, the Network Time Protocol, section 8).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/wire/health.h"
#include "core/wire/message_limits.h"

namespace tern {

/// The responding side of the exchange: remembers the newest heartbeat of each process, to be echoed. Pure.
class ClockEchoes {
 public:
  /// Older heartbeats are not echoed: the sender is gone, or the clocks may have drifted.
  static constexpr Duration kOldest{2'500'000};

  /// @param received  the listener's clock   @return whether the process is new, or was silent for kOldest
  bool receive(const Header& header, UTime received) {
    const std::int64_t epoch_us = header.name.sender_epoch_us;
    forget_before(received - kOldest);
    const bool is_new = echoes_.insert_or_assign(epoch_us, ClockEcho{epoch_us, header.utime, received}).second;
    if (echoes_.size() > static_cast<std::size_t>(kMaxClockEchoes)) {
      const auto earlier = [](const auto& a, const auto& b) { return a.second.received < b.second.received; };
      echoes_.erase(std::min_element(echoes_.begin(), echoes_.end(), earlier));
    }
    return is_new;
  }

  /// Returns at most kMaxClockEchoes echoes, in ascending order of their epochs.
  [[nodiscard]] std::vector<ClockEcho> echoes(UTime now) {
    forget_before(now - kOldest);
    std::vector<ClockEcho> result;
    for (const auto& [epoch_us, echo] : echoes_) result.push_back(echo);
    return result;
  }

 private:
  void forget_before(UTime t) {
    std::erase_if(echoes_, [t](const auto& entry) { return entry.second.received < t; });
  }

  std::map<std::int64_t, ClockEcho> echoes_;
};

/// The result of one exchange.
struct ClockReading {
  Duration ahead;       ///< the sender's clock minus the listener's; error ≤ round_trip / 2
  Duration round_trip;  ///< both ways, without the responder's waiting time, ≥ 0
};

/// The difference between one sender's clock and the listener's. Pure.
///
/// In an exchange the listener sends a heartbeat at T1, and the other process receives it at T2. The other echoes it at
/// T3, and the echo arrives at T4. The listener's clock gives T1 and T4, the other's T2 and T3.
///
///     ahead      = ((T2 − T1) + (T3 − T4)) / 2
///     round trip = (T4 − T1) − (T3 − T2),  |error of ahead| ≤ round trip / 2
///
/// A delay that is equal in both directions cancels. Of the newest kWindow exchanges, reading() uses the one with the
/// shortest round trip (RFC 5905 section 10, the clock filter). After a sender's clock was set, the reading follows
/// within kWindow exchanges.
class ClockSkew {
 public:
  static constexpr std::size_t kWindow = 6;  ///< three seconds of heartbeats

  /// Adds an exchange. It is ignored if its round trip is negative: a clock was set, or the sender's times are wrong.
  /// @param echo  of a heartbeat of the listener: T1 (sent), T2 (received)
  /// @param sent  T3
  /// @param received  T4
  void add(const ClockEcho& echo, UTime sent, UTime received) {
    const Duration out = echo.received - echo.sent;
    const Duration back = received - sent;
    if (out + back < Duration{}) return;
    readings_.push_back({{(out - back).us / 2}, out + back});
    if (readings_.size() > kWindow) readings_.pop_front();
  }

  /// @return nullopt before the first exchange.
  [[nodiscard]] std::optional<ClockReading> reading() const {
    if (readings_.empty()) return std::nullopt;
    return *std::min_element(readings_.begin(), readings_.end(),
                             [](const auto& a, const auto& b) { return a.round_trip < b.round_trip; });
  }

 private:
  std::deque<ClockReading> readings_;
};

}  // namespace tern
