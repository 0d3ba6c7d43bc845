// Wilson's interval of a success rate.
#pragma once

#include <cstdint>

namespace tern {

/// The two-sided 95 % quantile of the standard normal distribution, Φ⁻¹(0.975).
inline constexpr double kNormalQuantile95 = 1.959963984540054;

struct Interval {
  double low = 0.0, high = 1.0;
};

/// The Wilson score interval of k = `successes` out of n (E. B. Wilson, 1927): all rates p with
/// |k/n − p| ≤ z √(p (1 − p) / n). It stays within [0, 1], and is informative even for k = 0 and k = n. [0, 1] for
/// n = 0. @pre 0 ≤ successes ≤ n
Interval wilson_interval(std::int64_t successes, std::int64_t n, double z = kNormalQuantile95);

}  // namespace tern
