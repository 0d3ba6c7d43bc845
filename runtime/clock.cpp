#include "runtime/clock.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/stopwatch.h"

namespace tern {
namespace {

/// Two clocks are read in turn, and the thread may lose its core between. So the shortest of kTries is used, or the
/// first that took at most kShortNs.
constexpr int kTries = 20;
constexpr std::int64_t kShortNs = 200;

template <class C>
std::int64_t read_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(C::now().time_since_epoch()).count();
}

/// How far the system's real-time clock is ahead of its steady one, ns.
std::int64_t system_ahead_ns() {
  std::int64_t ahead = 0, shortest = std::numeric_limits<std::int64_t>::max();
  for (int k = 0; k < kTries && shortest > kShortNs; ++k) {
    const std::int64_t before = read_ns<std::chrono::steady_clock>();
    const std::int64_t system = read_ns<std::chrono::system_clock>();
    const std::int64_t took = read_ns<std::chrono::steady_clock>() - before;
    if (took >= shortest) continue;
    shortest = took;
    ahead = system - before - took / 2;
  }
  return ahead;
}

}  // namespace

WallClock::WallClock(Duration offset, double pace) : offset_(offset), pace_(pace), ahead_ns_(system_ahead_ns()) {}

UTime WallClock::at(std::int64_t unix_us) const {
  if (pace_ == 1.0) return UTime{unix_us} + offset_;
  return UTime{kPaceOriginUs + std::llround(static_cast<double>(unix_us - kPaceOriginUs) * pace_)} + offset_;
}

std::int64_t WallClock::system_time_us(UTime t, double pace) {
  if (pace == 1.0) return t.us;
  return kPaceOriginUs + std::llround(static_cast<double>(t.us - kPaceOriginUs) / pace);
}

UTime WallClock::now() const { return at((read_ns<std::chrono::steady_clock>() + ahead_ns_) / 1'000); }

UTime WallClock::at_system_time(std::int64_t unix_us) const { return at(unix_us - drift().us); }

Duration WallClock::drift() const { return {(system_ahead_ns() - ahead_ns_) / 1'000}; }

Duration WallClock::in_system_time(Duration span) const { return {std::llround(static_cast<double>(span.us) / pace_)}; }

void VirtualClock::advance_to(UTime t) {
  if (t < now_) throw std::invalid_argument(fmt::format("VirtualClock: {} us is before now, {} us", t.us, now_.us));
  now_ = t;
}

ThreadCpuClock::ThreadCpuClock(UTime start) : start_(start), cpu_at_start_ms_(thread_cpu_ms()) {}

UTime ThreadCpuClock::now() const {
  return start_ + Duration::from_seconds((thread_cpu_ms() - cpu_at_start_ms_) * 1e-3);
}

}  // namespace tern
