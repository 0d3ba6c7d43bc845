// Offset and rate of the autopilot's clock against ours, from TIMESYNC.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/base/time.h"

namespace tern::mavlink {

/// Fits the autopilot's time as a line over ours, to the exchanges of the last kWindow with a short round trip.
///
/// An exchange gives the offset to half its round trip. The rates of both clocks may differ (1 % was measured).
///
/// | an exchange is off the line by      | meaning                   | effect                             |
/// |-------------------------------------|---------------------------|------------------------------------|
/// | > kStep and half its round trip     | the rate has changed      | only the latest exchanges are kept |
/// | > 1 s                               | the autopilot restarted   | the fit begins anew                |
class ClockFit {
 public:
  static constexpr Duration kWindow{10'000'000};
  static constexpr Duration kStep{100'000};
  static constexpr std::size_t kMinExchanges = 5;

  /// Adds an exchange: a request sent at `sent` was answered at `received`, and the autopilot's clock read `theirs_us`.
  void add(UTime sent, std::int64_t theirs_us, UTime received);
  /// Converts its time to ours, and back. @return nullopt before kMinExchanges exchanges
  [[nodiscard]] std::optional<UTime> ours(std::int64_t theirs_us) const;
  [[nodiscard]] std::optional<std::int64_t> theirs_us(UTime ours) const;
  [[nodiscard]] double rate() const { return rate_; }  ///< seconds of its clock per second of ours
  [[nodiscard]] bool ready() const { return exchanges_.size() >= kMinExchanges; }
  [[nodiscard]] Duration round_trip() const;  ///< the shortest in the window

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
