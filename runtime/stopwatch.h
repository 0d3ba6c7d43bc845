// Measures durations; none of these is a time of day.
#pragma once

#include <cstdint>

namespace tern {

/// Monotonic wall time, ms; only differences are meaningful.
double monotonic_ms();

/// CPU time used by the calling thread, ms.
double thread_cpu_ms();

/// Largest resident memory of this process so far, kB.
std::int64_t peak_rss_kb();

}  // namespace tern
