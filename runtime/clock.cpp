#include "runtime/clock.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

#include "runtime/stopwatch.h"

namespace tern {

UTime WallClock::now() const {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return UTime{std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count()} + offset_;
}

void VirtualClock::advance_to(UTime t) {
  if (t < now_) throw std::invalid_argument(fmt::format("VirtualClock: {} us is before now, {} us", t.us, now_.us));
  now_ = t;
}

ThreadCpuClock::ThreadCpuClock(UTime start) : start_(start), cpu_at_start_ms_(thread_cpu_ms()) {}

UTime ThreadCpuClock::now() const {
  return start_ + Duration::from_seconds((thread_cpu_ms() - cpu_at_start_ms_) * 1e-3);
}

}  // namespace tern
