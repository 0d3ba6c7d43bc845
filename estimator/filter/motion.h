// The motion of the body under an IMU: the mean, and the transition of the right-invariant error with its noise.
#pragma once

#include "core/base/types.h"
#include "estimator/config.h"

namespace tern {

/// The state of the body in W, and the biases of its IMU.
///
/// The error (θ, e_p, e_v, b̃_g, b̃_a) is right-invariant: R = Exp(θ) R̂, p = Exp(θ) p̂ + e_p, v = Exp(θ) v̂ + e_v; biases
/// are additive. To correct, e_p and e_v pass through the left Jacobian of θ, so (θ, e_p, e_v) is the logarithm of the
/// group SE₂(3).
struct NavState {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_WB
  Vec3 p = Vec3::Zero();                            ///< m
  Vec3 v = Vec3::Zero();                            ///< m/s
  Vec3 gyro_bias = Vec3::Zero();                    ///< rad/s
  Vec3 accel_bias = Vec3::Zero();                   ///< m/s²
};

/// First indices of the errors.
inline constexpr int kTheta = 0, kErrorP = 3, kErrorV = 6, kErrorBg = 9, kErrorBa = 12;
inline constexpr int kNavErrors = 15;
using NavMatrix = Eigen::Matrix<double, kNavErrors, kNavErrors>;
using NavVector = Eigen::Matrix<double, kNavErrors, 1>;

/// Means of the IMU over a time h.
struct ImuStep {
  Vec3 rate = Vec3::Zero();   ///< rad/s, with bias
  Vec3 force = Vec3::Zero();  ///< m/s², with bias
  double h = 0.0;             ///< s, ≥ 0
  /// Standard deviations of an error that is constant over h, beside the noise: of a bridged gap or a saturated sample.
  double extra_rate = 0.0;   ///< rad/s
  double extra_force = 0.0;  ///< m/s²
};

/// Returns the state after the step: exact for a constant rate and a constant force in B.
NavState moved(const NavState& state, const ImuStep& step, double gravity);

/// The change of the error over a step: ε⁺ = Φ ε + w, w ~ N(0, Q).
struct ErrorTransition {
  NavMatrix Phi;
  NavMatrix Q;
};

/// Φ = 1 + A h + A² h²/2 and Q = G diag(n²) Gᵀ h with
///
///     θ̇ = −R̂(b̃_g + n_g),   ė_p = e_v − [p̂]× R̂(b̃_g + n_g),   ė_v = [g]× θ − [v̂]× R̂(b̃_g + n_g) − R̂(b̃_a + n_a)
///
/// A depends on the estimate in the biases' columns only. The unobservable directions of the error, position and yaw in
/// W, are therefore the same at all times.
/// @param half  the state half a step ahead
ErrorTransition error_transition(const NavState& half, const ImuStep& step, const ImuNoise& noise, double gravity);

/// Returns the state corrected by an error.
NavState corrected(const NavState& state, const NavVector& error);

/// Returns the error of `estimate`: corrected(estimate, error_of(estimate, truth)) is `truth`.
NavVector error_of(const NavState& estimate, const NavState& truth);

/// Returns J with (φ, δp, δv, b̃_g, b̃_a) = J ε to first order: δp = e_p − [p̂]× θ is the error of the position itself.
NavMatrix ordinary_error_jacobian(const NavState& state);

}  // namespace tern
