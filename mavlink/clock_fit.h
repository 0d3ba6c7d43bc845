// The autopilot's clock against ours, by TIMESYNC: offset and rate.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/base/time.h"

namespace tern::mavlink {

/// Its time as a line over ours, fitted to the exchanges of the last kWindow whose round trip is short. The offset of
/// one is known to half its round trip, and its clock may run at another rate (1 % was seen). After an exchange that is
/// off the line by more than kStep and half its round trip only the latest ones count: the rate has changed. After one
/// that is off by more than a second all begins anew: the autopilot has restarted.
class ClockFit {
 public:
  static constexpr Duration kWindow{10'000'000};
  static constexpr Duration kStep{100'000};
  static constexpr std::size_t kMinExchanges = 5;

  /// A question that left at `sent` came back at `received`; between them its clock read `theirs_us`.
  void add(UTime sent, std::int64_t theirs_us, UTime received);
  /// Our time at its time. @return nullopt before kMinExchanges exchanges
  [[nodiscard]] std::optional<UTime> ours(std::int64_t theirs_us) const;
  [[nodiscard]] std::optional<std::int64_t> theirs_us(UTime ours) const;
  [[nodiscard]] double rate() const { return rate_; }  ///< its seconds per second of ours
  [[nodiscard]] bool ready() const { return exchanges_.size() >= kMinExchanges; }
  [[nodiscard]] Duration round_trip() const;  ///< the shortest of the window

 private:
  struct Exchange {
    UTime middle;
    std::int64_t theirs_us = 0;
    Duration round_trip;
  };
  void fit();
  std::deque<Exchange> exchanges_;
  UTime origin_;  // the line: theirs = theirs_origin_us_ + rate_ (ours − origin_)
  double theirs_origin_us_ = 0.0;
  double rate_ = 1.0;
  bool rate_is_known_ = false;
};

}  // namespace tern::mavlink
