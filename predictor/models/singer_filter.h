// A Kalman filter of position, velocity and acceleration on one axis: Singer's model of manoeuvring targets.
// R. A. Singer, "Estimating optimal tracking filter performance for manned maneuvering targets", IEEE Trans. Aerospace
// and Electronic Systems 6(4), 1970.
#pragma once

#include <Eigen/Core>

namespace tern {

/// Acceleration is a stationary Gauss-Markov process, ȧ = −a/τ + w, of standard deviation σ: what accelerates goes on
/// to do so for about τ. With τ = 0 acceleration is white of spectral density σ² and the model is that of AxisFilter.
struct AccelerationModel {
  double sigma = 2.0;   ///< τ > 0: m/s²; τ = 0: √ of the spectral density, m/s^1.5; ≥ 0
  double time_s = 0.0;  ///< τ, s, ≥ 0
};

/// What the model does to a state (x, v, a) over dt: s ← Φ s, P ← Φ P Φᵀ + Q.
struct Transition {
  Eigen::Matrix3d phi;
  Eigen::Matrix3d q;
};

/// With g(s) = (τ²(s/τ − 1 + e^{−s/τ}), τ(1 − e^{−s/τ}), e^{−s/τ}), the response to an impulse of w:
///   Φ = [1 dt g₁; 0 1 g₂; 0 0 g₃](dt),   Q = 2σ²/τ ∫₀^dt g gᵀ ds  (by Gauss' rule, relative error < 1e-9 up to dt = 5
///   τ);
/// τ = 0: g = (s, 1, 0) and Q = σ² ∫ g gᵀ. Two steps make the same as one step of their sum.
/// @param dt s, ≥ 0.
Transition transition(const AccelerationModel& model, double dt);

/// State (x, v, a), m, m/s, m/s², with its covariance, all of one axis of W.
struct SingerFilter {
  Eigen::Vector3d state = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();

  void predict(const Transition& step);
  /// Of a position. @param z m; @param r m², taken as kLeastVariance if less.
  void update(double z, double r);
  /// (z − x)²/S: χ² with one degree of freedom where the model holds.
  [[nodiscard]] double distance2(double z, double r) const;
};

}  // namespace tern
