// A Kalman filter of position and velocity on one axis under white-noise acceleration.
// Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and Navigation", §5.2, §6.2.2.
#pragma once

#include <cmath>

#include "core/base/types.h"

namespace tern {

/// No measurement is taken to be better than this, m²: 0.1 mm standard deviation. A sensor may say 0 (it gives truth),
/// and a filter with S = 0 has no gain.
inline constexpr double kMinVariance = 1e-8;

/// State (x, v) with covariance P = [xx xv; xv vv], all of one axis of W.
///
/// Motion: ẋ = v, v̇ = w, w white with spectral density q (m²/s³). Over dt, with F = [1 dt; 0 1]:
///   (x, v) ← F (x, v),   P ← F P Fᵀ + q [dt³/3 dt²/2; dt²/2 dt],
/// so that two steps make the same as one step of their sum. Measurement: z = x + n, n of variance r:
///   S = xx + r, K = (xx, xv)/S, (x, v) ← (x, v) + K (z − x), P ← P − K S Kᵀ.
struct AxisFilter {
  double x = 0.0;   ///< m
  double v = 0.0;   ///< m/s
  double xx = 1.0;  ///< m², > 0
  double xv = 0.0;  ///< m²/s
  double vv = 1.0;  ///< m²/s², > 0

  /// @param dt s, ≥ 0; @param q m²/s³, ≥ 0.
  void predict(double dt, double q);
  /// @param z m; @param r m², taken as kLeastVariance if less.
  void update(double z, double r);
};

/// How well a detection fits an estimate, over three axes with S the variance of their difference.
struct Fit {
  Vec3 s = Vec3::Zero();   ///< S, m²
  double distance2 = 0.0;  ///< Σ (z − x)²/S: χ² with three degrees of freedom where the model holds
  /// −2 ln of the density of the detection, but for a constant; ≥ 0. A distance alone is least for the estimate that
  /// knows least.
  [[nodiscard]] double neg_log_likelihood() const { return distance2 + std::log((s / kMinVariance).prod()); }
};

/// @param x, variance  m, m², of the estimate; @param z, r  of the detection, r taken as kLeastVariance if less
Fit fit(const Vec3& x, const Vec3& variance, const Vec3& z, const Vec3& r);

/// A box that holds all z with Fit::distance2 ≤ gate, of detections of at most the variance r (m²), and little more: no
/// axis has more than the whole distance.
Box gate_box(const Vec3& x, const Vec3& variance, double gate, const Vec3& r);

}  // namespace tern
