// How far another process's clock is from this one's, and how long messages take between them. Heartbeats that echo
// what they heard tell it (RFC 5905, the Network Time Protocol, section 8).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/world/health.h"
#include "core/world/message_limits.h"

namespace tern {

/// The other's side of the exchange: remembers the newest heartbeat of each process, to be told back. Pure.
class ClockEchoes {
 public:
  /// What is older is not told back: its sender is gone, or the clocks have drifted since.
  static constexpr Duration kOldest{2'500'000};

  /// @param received  the listener's clock   @return whether this process was not known, or not heard for kOldest
  bool receive(const Header& header, UTime received) {
    const std::int64_t epoch_us = header.name.sender_epoch_us;
    forget_before(received - kOldest);
    const bool is_new = heard_.insert_or_assign(epoch_us, ClockEcho{epoch_us, header.utime, received}).second;
    if (heard_.size() > static_cast<std::size_t>(kMaxClockEchoes)) {
      const auto earlier = [](const auto& a, const auto& b) { return a.second.received < b.second.received; };
      heard_.erase(std::min_element(heard_.begin(), heard_.end(), earlier));
    }
    return is_new;
  }

  /// At most kMaxClockEchoes, by epoch ascending.
  [[nodiscard]] std::vector<ClockEcho> echoes(UTime now) {
    forget_before(now - kOldest);
    std::vector<ClockEcho> result;
    for (const auto& [epoch_us, echo] : heard_) result.push_back(echo);
    return result;
  }

 private:
  void forget_before(UTime t) {
    std::erase_if(heard_, [t](const auto& entry) { return entry.second.received < t; });
  }

  std::map<std::int64_t, ClockEcho> heard_;
};

/// What exchanges said of another's clock.
struct ClockReading {
  Duration ahead;       ///< of the listener's; negative: behind. Off by half the round trip at most
  Duration round_trip;  ///< both ways together, without the time between hearing and answering, ≥ 0
};

/// One sender's clock against the listener's. Pure.
///
/// In an exchange the listener sends a heartbeat at T1, which the other receives at T2. The other echoes it at T3,
/// which comes at T4. T1 and T4 are by the listener's clock, T2 and T3 by the other's. Then the other is ahead by ((T2
/// − T1) + (T3 − T4)) / 2, off by at most half the round trip (T4 − T1) − (T3 − T2). A delay that is the same both ways
/// moves nothing. Of the newest kWindow exchanges the one of the shortest round trip counts (section 10, the clock
/// filter). A clock that is set while the sender runs is believed after kWindow exchanges at most.
class ClockSkew {
 public:
  static constexpr std::size_t kWindow = 6;  ///< three seconds of heartbeats

  /// What came before it was sent (a clock was set, or the sender lies) is left out.
  /// @param echo  of a heartbeat of the listener
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
