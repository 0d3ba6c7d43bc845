// How long things took: never what time it is.
#pragma once

#include <chrono>
#include <cstdint>

namespace tern {

/// Monotonic wall time since construction.
class Stopwatch {
 public:
  [[nodiscard]] double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Monotonic wall time, ms; only differences mean anything.
double monotonic_ms();

/// CPU time that the calling thread has used, ms.
double thread_cpu_ms();

/// The most memory that this process has had resident, kB.
std::int64_t peak_rss_kb();

}  // namespace tern
