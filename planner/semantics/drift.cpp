#include "planner/semantics/drift.h"

#include <algorithm>
#include <cmath>

#include "core/world/thrust.h"

namespace tern {
namespace {

/// Coefficients of τ² … τ⁶ of dark_variance().
struct DarkPolynomial {
  double c2, c3, c4, c5, c6;
};

constexpr DarkPolynomial dark_polynomial() {
  const InertialNoise n = kFlightNoise;
  const SightedSigma s = kSightedSigma;
  const double g2 = kGravity * kGravity;
  const double tilt = g2 * n.rate * n.rate / 20.0, walk = n.force_walk * n.force_walk / 20.0;
  return {3.0 * s.velocity * s.velocity, n.force * n.force, 0.75 * s.acceleration * s.acceleration,
          3.0 * walk + 2.0 * tilt, 2.0 * g2 * s.rate_bias * s.rate_bias / 36.0};
}

constexpr DarkPolynomial kDark = dark_polynomial();

}  // namespace

double dark_variance(double t) {
  return t * t * (kDark.c2 + t * (kDark.c3 + t * (kDark.c4 + t * (kDark.c5 + t * kDark.c6))));
}

double dark_growth(double t) {
  return t * (2.0 * kDark.c2 + t * (3.0 * kDark.c3 + t * (4.0 * kDark.c4 + t * (5.0 * kDark.c5 + t * 6.0 * kDark.c6))));
}

namespace {

/// The derivative of dark_growth(), m²/s².
double dark_acceleration(double t) {
  return 2.0 * kDark.c2 + t * (6.0 * kDark.c3 + t * (12.0 * kDark.c4 + t * (20.0 * kDark.c5 + t * 30.0 * kDark.c6)));
}
constexpr int kNewtonSteps = 20;  ///< five are usual

}  // namespace

double sighted_growth(double translation_m, double frame_s) {
  return kTrackGain * kTrackGain * translation_m * translation_m / frame_s;
}

double equal_dark_time(double growth) {
  if (dark_growth(kLongestDark) <= growth) return kLongestDark;
  // Each term alone bounds τ from above. The growth is convex there, so Newton's steps descend to the solution.
  double t = std::min({growth / (2.0 * kDark.c2), std::sqrt(growth / (3.0 * kDark.c3)),
                       std::sqrt(std::sqrt(growth / (5.0 * kDark.c5)))});
  for (int k = 0; k < kNewtonSteps; ++k) {
    const double excess = dark_growth(t) - growth;
    if (excess <= 1e-12 * growth) break;
    t -= excess / dark_acceleration(t);
  }
  return t;
}

void Drift::extend(double length, double seconds, double growth, double equal_dark_s) {
  way += length;
  if (dark_s >= equal_dark_s) {  // it sees again, or still
    dark_s = equal_dark_s;
    variance += growth * seconds;
    return;
  }
  const double before = dark_variance(dark_s);
  const double blind_s = std::min(seconds, equal_dark_s - dark_s);
  dark_s += blind_s;
  const double after = dark_variance(dark_s);
  largest_dark = std::max(largest_dark, after);
  variance += kDarkKept * (after - before) + growth * (seconds - blind_s);
}

double Drift::at_goal() const { return std::sqrt(kTiltDrift * kTiltDrift * way * way + variance); }

double Drift::at_worst() const { return std::sqrt(kTiltDrift * kTiltDrift * way * way + variance + largest_dark); }

}  // namespace tern
