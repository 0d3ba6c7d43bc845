#include "campaign/statistics/wilson.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tern {

Interval wilson_interval(std::int64_t successes, std::int64_t n, double z) {
  if (successes < 0 || successes > n) {
    throw std::invalid_argument("wilson_interval: " + std::to_string(successes) + " of " + std::to_string(n));
  }
  if (n == 0) return {};
  const double count = static_cast<double>(n);
  const double rate = static_cast<double>(successes) / count;
  const double z2 = z * z / count;
  const double centre = (rate + z2 / 2.0) / (1.0 + z2);
  const double half = z * std::sqrt(rate * (1.0 - rate) / count + z2 / (4.0 * count)) / (1.0 + z2);
  // At the ends the formula gives 0 and 1 up to rounding.
  return {successes == 0 ? 0.0 : std::max(0.0, centre - half), successes == n ? 1.0 : std::min(1.0, centre + half)};
}

}  // namespace tern
