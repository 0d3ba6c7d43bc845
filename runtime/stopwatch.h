// How long things took: never what time it is.
#pragma once

#include <cstdint>

namespace tern {

/// Monotonic wall time, ms; only differences mean anything.
double monotonic_ms();

/// CPU time that the calling thread has used, ms.
double thread_cpu_ms();

/// The most memory that this process has had resident, kB.
std::int64_t peak_rss_kb();

}  // namespace tern
