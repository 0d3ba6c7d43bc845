// The only clocks in Tern. Libraries get times as arguments.
#pragma once

#include <cstdint>

#include "core/base/time.h"

namespace tern {

class Clock {
 public:
  virtual ~Clock() = default;
  /// Never goes back.
  [[nodiscard]] virtual UTime now() const = 0;
  /// What this clock showed when the system's real-time clock showed `unix_us`, µs since the Unix epoch, lately: not
  /// before that was set last. A clock that has nothing to do with the system's says now().
  [[nodiscard]] virtual UTime at_system_time(std::int64_t /*unix_us*/) const { return now(); }
  /// How far the system's real-time clock has been set forward (negative: back) since this clock was made.
  [[nodiscard]] virtual Duration drift() const { return {}; }
  /// How long this clock takes for `span` by the system's.
  [[nodiscard]] virtual Duration in_system_time(Duration span) const { return span; }
};

/// The system's real-time clock when this was made, and from there on its steady one. What slews the one (chrony, PTP)
/// slews the other, but setting the system's clock does not set this. Plus a fixed offset (`--clock-offset-us`, so that
/// skew can be tested). At a pace below 1 (`--pace`) it goes slower by that factor since kPaceOriginUs. All clocks of
/// one pace agree, and a flight has more of the machine for each of its seconds. Thread-safe.
class WallClock final : public Clock {
 public:
  /// 2026-01-01 00:00 UTC, µs since the Unix epoch.
  static constexpr std::int64_t kPaceOriginUs = 1'767'225'600'000'000;

  /// @pre 0 < pace ≤ 1
  explicit WallClock(Duration offset = {}, double pace = 1.0);
  /// What the system's clock showed, µs since the Unix epoch, when one of this pace without an offset showed `t`.
  static std::int64_t system_time_us(UTime t, double pace);
  [[nodiscard]] UTime now() const override;
  [[nodiscard]] UTime at_system_time(std::int64_t unix_us) const override;
  [[nodiscard]] Duration drift() const override;
  [[nodiscard]] Duration in_system_time(Duration span) const override;

 private:
  /// What this shows when the system's steady clock plus ahead_ns_ shows `unix_us`.
  [[nodiscard]] UTime at(std::int64_t unix_us) const;

  Duration offset_;
  double pace_;
  std::int64_t ahead_ns_;  ///< the system's clock, of the steady one, when this was made
};

/// Time that moves only when told to: tests and campaigns.
class VirtualClock final : public Clock {
 public:
  explicit VirtualClock(UTime start) : now_(start) {}
  [[nodiscard]] UTime now() const override { return now_; }
  /// @pre t ≥ now()
  void advance_to(UTime t);

 private:
  UTime now_;
};

/// A time from which only the calling thread's CPU time counts on, whoever else uses the machine.
/// @pre now() is called by the thread that made it
class ThreadCpuClock final : public Clock {
 public:
  explicit ThreadCpuClock(UTime start);
  [[nodiscard]] UTime now() const override;

 private:
  UTime start_;
  double cpu_at_start_ms_;
};

}  // namespace tern
