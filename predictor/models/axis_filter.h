// A Kalman filter of position and velocity on one axis under white-noise acceleration.
// Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and Navigation", §5.2, §6.2.2.
#pragma once

#include <cmath>

#include "core/base/types.h"

namespace tern {

/// The least variance of a measurement, m²: 0.1 mm standard deviation. A sensor of ground truth reports 0, and with
/// S = 0 a filter has no gain.
inline constexpr double kMinVariance = 1e-8;

/// The state (x, v) of one axis of W with its covariance P = [xx xv; xv vv].
///
/// Motion: ẋ = v, v̇ = w, w white with spectral density q (m²/s³).
///
/// Over dt, with F = [1 dt; 0 1],
///   (x, v) ← F (x, v),   P ← F P Fᵀ + q [dt³/3 dt²/2; dt²/2 dt].
/// Two steps equal one step of their sum.
///
/// Measurement: z = x + n, n of variance r. Then
///   S = xx + r, K = (xx, xv)/S, (x, v) ← (x, v) + K (z − x), P ← P − K S Kᵀ.
struct AxisFilter {
  double x = 0.0;   ///< m
  double v = 0.0;   ///< m/s
  double xx = 1.0;  ///< m², > 0
  double xv = 0.0;  ///< m²/s
  double vv = 1.0;  ///< m²/s², > 0

  /// @param dt s, ≥ 0; @param q m²/s³, ≥ 0.
  void predict(double dt, double q);
  /// @param z m; @param r m², raised to kMinVariance if less
  void update(double z, double r);
};

/// How well a detection z fits an estimate x on three axes. S is the variance of z − x.
struct Fit {
  Vec3 s = Vec3::Zero();   ///< S, m²
  double distance2 = 0.0;  ///< Σ (z − x)²/S: χ² with three degrees of freedom if the model is right.
  /// Returns −2 ln of the detection's density, up to a constant: twice the negative log likelihood, ≥ 0. Unlike
  /// distance2 it does not favour the estimate with the largest variance.
  [[nodiscard]] double neg_log_likelihood() const { return distance2 + std::log((s / kMinVariance).prod()); }
};

/// @param x, variance  of the estimate, m, m²; @param z, r  of the detection, r raised to kMinVariance if less
Fit fit(const Vec3& x, const Vec3& variance, const Vec3& z, const Vec3& r);

/// Returns a box that contains every z with Fit::distance2 ≤ gate, for detections with a variance of at most r (m²). It
/// is the bounding box of the gate's ellipsoid for r.
Box gate_box(const Vec3& x, const Vec3& variance, double gate, const Vec3& r);

}  // namespace tern
