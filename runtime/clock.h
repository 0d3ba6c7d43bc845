// The only clocks in Tern. Libraries receive times as arguments.
#pragma once

#include <cstdint>

#include "core/base/time.h"

namespace tern {

/// A clock that never goes back.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual UTime now() const = 0;
  /// This clock's time at the moment when the system's real-time clock showed `unix_us`, µs since the Unix epoch. A
  /// clock that is unrelated to the system's returns now().
  /// @pre the system's clock has not been set since then
  [[nodiscard]] virtual UTime at_system_time(std::int64_t /*unix_us*/) const { return now(); }
  /// How far the system's real-time clock was set forward (negative: back) since this clock was made.
  [[nodiscard]] virtual Duration drift() const { return {}; }
  /// The system's time that passes while this clock advances by `span`.
  [[nodiscard]] virtual Duration in_system_time(Duration span) const { return span; }
};

/// The system's real-time clock at construction, continued by the steady clock. Setting the system's clock does not
/// move it; slewing (chrony, PTP) affects it like the system's clock.
///
/// @param offset  is added (`--clock-offset-us`), so that clock skew can be tested.
/// @param pace a value below 1 slows the clock by that factor since kPaceOriginUs (`--pace`), so a second of flight has
///   more computing time. All clocks with the same pace agree.
///
/// Thread-safe.
class WallClock final : public Clock {
 public:
  /// 2026-01-01 00:00 UTC, µs since the Unix epoch.
  static constexpr std::int64_t kPaceOriginUs = 1'767'225'600'000'000;

  /// @pre 0 < pace ≤ 1
  explicit WallClock(Duration offset = {}, double pace = 1.0);
  /// The system's time, µs since the Unix epoch, at which a clock of this pace without offset shows `t`.
  static std::int64_t system_time_us(UTime t, double pace);
  [[nodiscard]] UTime now() const override;
  [[nodiscard]] UTime at_system_time(std::int64_t unix_us) const override;
  [[nodiscard]] Duration drift() const override;
  [[nodiscard]] Duration in_system_time(Duration span) const override;

 private:
  /// The time shown when the system's steady clock plus ahead_ns_ shows `unix_us`.
  [[nodiscard]] UTime at(std::int64_t unix_us) const;

  Duration offset_;
  double pace_;
  std::int64_t ahead_ns_;  ///< real-time minus steady clock at construction, ns
};

/// A clock that is moved by its owner: tests and campaigns.
class VirtualClock final : public Clock {
 public:
  explicit VirtualClock(UTime start) : now_(start) {}
  [[nodiscard]] UTime now() const override { return now_; }
  /// @pre t ≥ now()
  void advance_to(UTime t);

 private:
  UTime now_;
};

/// A clock that advances with the CPU time of the thread that made it, independent of the machine's load.
/// @pre now() is called by that thread
class ThreadCpuClock final : public Clock {
 public:
  explicit ThreadCpuClock(UTime start);
  [[nodiscard]] UTime now() const override;

 private:
  UTime start_;
  double cpu_at_start_ms_;
};

}  // namespace tern
