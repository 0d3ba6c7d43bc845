// The only clocks in Tern. Libraries get times as arguments.
#pragma once

#include <cstdint>

#include "core/base/time.h"

namespace tern {

class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual UTime now() const = 0;
  /// What this clock showed when the system's real-time clock showed `unix_us`, µs since the Unix epoch. A clock that
  /// has nothing to do with the system's says now().
  [[nodiscard]] virtual UTime at_system_time(std::int64_t /*unix_us*/) const { return now(); }
};

/// The system's real-time clock plus a fixed offset (`--clock-offset-us`, so that skew can be tested).
class WallClock final : public Clock {
 public:
  explicit WallClock(Duration offset = {}) : offset_(offset) {}
  [[nodiscard]] UTime now() const override;
  [[nodiscard]] UTime at_system_time(std::int64_t unix_us) const override { return UTime{unix_us} + offset_; }

 private:
  Duration offset_;
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

/// A time from which only the calling thread's CPU time counts on: what the thread's work takes, whoever else uses the
/// machine. @pre now() is called by the thread that made it
class ThreadCpuClock final : public Clock {
 public:
  explicit ThreadCpuClock(UTime start);
  [[nodiscard]] UTime now() const override;

 private:
  UTime start_;
  double cpu_at_start_ms_;
};

}  // namespace tern
