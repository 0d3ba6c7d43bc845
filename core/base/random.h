// The one random generator: mt19937_64 with draws (x >> 11)·2⁻⁵³, equal on every platform (BENCHMARKS: worlds).
#pragma once

#include <cstdint>
#include <random>

namespace tern {

/// Seeded draws that are the same on every standard library (std::uniform_real_distribution is not).
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// Uniform in [lo, hi).
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Standard normal, by the polar method (two draws or more of uniform()).
  double normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace tern
