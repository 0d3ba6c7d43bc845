// Time as integer microseconds. All arithmetic with times uses these types. Absolute times are subtracted as integers,
// because a double holds the microseconds of an epoch only with a rounding error.
#pragma once

#include <compare>
#include <cstdint>

namespace tern {

/// A span of time in microseconds; it may be negative.
struct Duration {
  std::int64_t us = 0;

  /// Returns s seconds, rounded to the nearest microsecond.
  static constexpr Duration from_seconds(double s) {
    return {static_cast<std::int64_t>(s * 1e6 + (s < 0.0 ? -0.5 : 0.5))};
  }
  [[nodiscard]] constexpr double seconds() const { return static_cast<double>(us) * 1e-6; }
  friend constexpr auto operator<=>(Duration, Duration) = default;
  friend constexpr Duration operator+(Duration a, Duration b) { return {a.us + b.us}; }
  friend constexpr Duration operator-(Duration a, Duration b) { return {a.us - b.us}; }
  friend constexpr Duration operator*(Duration a, std::int64_t k) { return {a.us * k}; }
};

/// A point in time: microseconds since the Unix epoch in a live flight, since the world's start in virtual time.
struct UTime {
  std::int64_t us = 0;

  friend constexpr auto operator<=>(UTime, UTime) = default;
  friend constexpr UTime operator+(UTime t, Duration d) { return {t.us + d.us}; }
  friend constexpr UTime operator-(UTime t, Duration d) { return {t.us - d.us}; }
  friend constexpr Duration operator-(UTime a, UTime b) { return {a.us - b.us}; }
};

}  // namespace tern
