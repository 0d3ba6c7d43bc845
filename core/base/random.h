// Tern's random generator: std::mt19937_64, whose outputs x become uniform numbers (x >> 11) · 2⁻⁵³.
#pragma once

#include <cstdint>
#include <random>

namespace tern {

/// Seeded random numbers that are the same with every standard library. (The sequence of
/// std::uniform_real_distribution depends on the library.)
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}

  /// Returns a number from the uniform distribution on [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// Returns a number from the uniform distribution on [lo, hi).
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Returns a number from the standard normal distribution, by the polar method. Calls uniform() at least twice.
  double normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace tern
