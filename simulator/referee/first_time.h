// Finds the first time at which a function is negative. A known Lipschitz constant bounds the function between samples.
#pragma once

#include <optional>

namespace tern {

/// Returns the first t in [t0, t1] with f(t) < 0, to `resolution`, for f with |f(a) − f(b)| ≤ lipschitz·|a − b|.
///
/// An interval is halved until the bound proves that f is positive on it, or its half is at most `resolution`. The
/// returned t has f(t) < 0. An earlier excursion below zero may be missed if it is no deeper than lipschitz·resolution.
/// The cost is logarithmic for a crossing, and up to (t1 − t0)/resolution for an f that stays near zero.
/// @pre t0 ≤ t1, lipschitz ≥ 0, resolution > 0.
template <class F>
std::optional<double> first_time_below_zero(const F& f, double lipschitz, double t0, double t1, double resolution) {
  if (f(t0) < 0.0) return t0;
  const double half = 0.5 * (t1 - t0);
  const double middle = t0 + half;
  const double value = f(middle);
  if (value - lipschitz * half > 0.0) return std::nullopt;
  if (half <= resolution) {
    if (value < 0.0) return middle;
    return f(t1) < 0.0 ? std::optional<double>(t1) : std::nullopt;
  }
  if (const auto early = first_time_below_zero(f, lipschitz, t0, middle, resolution)) return early;
  return first_time_below_zero(f, lipschitz, middle, t1, resolution);
}

}  // namespace tern
