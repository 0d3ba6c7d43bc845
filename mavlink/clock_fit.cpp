#include "mavlink/clock_fit.h"

#include <algorithm>
#include <cmath>

namespace tern::mavlink {
namespace {

/// Shortest span for a rate, µs.
constexpr double kRateSpan = 1e6;
/// A clock that is off by more has restarted.
constexpr Duration kRestart{1'000'000};
/// Shorter delays in queues are tolerated.
constexpr Duration kQueue{1'000};

}  // namespace

void ClockFit::add(UTime sent, std::int64_t theirs_us, UTime received) {
  if (received < sent || received - sent > Duration{1'000'000}) return;
  const UTime middle{sent.us + (received.us - sent.us) / 2};
  if (const auto expected = ours(theirs_us)) {
    const Duration off = middle - *expected;
    // An exchange gives the offset to half its round trip; at first the rate is unknown.
    const Duration span = middle - exchanges_.front().middle, unknown{rate_is_known_ ? 0 : span.us / 2};
    const Duration most = kStep + (middle - sent) + unknown;
    if (off > kRestart || off < kRestart * -1) {
      exchanges_.clear();
    } else if (off > most || off < most * -1) {
      while (exchanges_.size() >= kMinExchanges) exchanges_.pop_front();
    }
  }
  exchanges_.push_back({middle, theirs_us, received - sent});
  while (exchanges_.front().middle + kWindow < middle) exchanges_.pop_front();
  fit();
}

Duration ClockFit::round_trip() const {
  Duration shortest{1'000'000};
  for (const Exchange& e : exchanges_) shortest = std::min(shortest, e.round_trip);
  return shortest;
}

void ClockFit::fit() {
  const Duration longest = round_trip() * 2 + kQueue;
  origin_ = exchanges_.back().middle;
  const std::int64_t theirs_origin = exchanges_.back().theirs_us;
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, first = 0.0, last = -1e12;
  for (const Exchange& e : exchanges_) {
    if (e.round_trip > longest) continue;
    const auto dx = static_cast<double>((e.middle - origin_).us), dy = static_cast<double>(e.theirs_us - theirs_origin);
    n += 1.0, x += dx, y += dy, xx += dx * dx, xy += dx * dy;
    first = std::min(first, dx), last = std::max(last, dx);
  }
  const double spread = xx - x * x / n;
  rate_is_known_ = last - first >= kRateSpan;
  rate_ = rate_is_known_ ? (xy - x * y / n) / spread : 1.0;
  theirs_origin_us_ = static_cast<double>(theirs_origin) + (y - rate_ * x) / n;
}

std::optional<UTime> ClockFit::ours(std::int64_t theirs_us) const {
  if (!ready()) return std::nullopt;
  const double since = (static_cast<double>(theirs_us) - theirs_origin_us_) / rate_;
  if (!(std::abs(since) < 1e15)) return std::nullopt;
  return origin_ + Duration{std::llround(since)};
}

std::optional<std::int64_t> ClockFit::theirs_us(UTime ours) const {
  if (!ready()) return std::nullopt;
  return std::llround(theirs_origin_us_ + rate_ * static_cast<double>((ours - origin_).us));
}

}  // namespace tern::mavlink
