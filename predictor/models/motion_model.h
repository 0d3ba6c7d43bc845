// Motion of one axis as a linear stochastic differential equation, and its exact discretisation.
#pragma once

#include <Eigen/Core>

namespace tern {

inline constexpr int kMaxOrder = 7;
/// Square matrices and columns of a model's order, without heap memory.
using ModelMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxOrder, kMaxOrder>;

using ModelVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxOrder, 1>;

enum class MotionFamily { ConstantVelocity, Singer, Matern52, SquaredExponential };

/// ds = F s dt + dw with E[dw dwᵀ] = D dt. In every model s_0 is the position (m) and s_1 the velocity (m/s). The
/// position has no prior: after its first measurement z with variance r, s ~ N(z u, P_0 + r u uᵀ).
struct MotionModel {
  MotionFamily family = MotionFamily::ConstantVelocity;
  double time_s = 0.0;     ///< memory of the model: τ of Singer, ℓ of a Gaussian process; 0: unlimited
  double amplitude = 1.0;  ///< q of constant_velocity(), sigma of singer(), speed of the Gaussian processes
  double rate = 0.0;       ///< 1/s, an upper bound of the rate at which e^{Ft} changes; 0: F is nilpotent
  ModelMatrix drift;       ///< F, of order 2 … kMaxOrder
  ModelMatrix diffusion;   ///< D
  ModelMatrix prior;       ///< P_0, covariance of the state given the position
  ModelVector shift;       ///< u: s + c u is the same motion, shifted by c m

  [[nodiscard]] int order() const { return static_cast<int>(drift.rows()); }
};

/// Velocity is a Wiener process. @param q √ of the spectral density of acceleration, m/s^1.5, > 0; @param speed prior
/// standard deviation of the velocity, m/s, > 0
MotionModel constant_velocity(double q, double speed);

/// Acceleration is a stationary Gauss-Markov process with the standard deviation `sigma` (m/s²) and the time constant
/// tau (s): R. A. Singer, "Estimating optimal tracking filter performance for manned maneuvering targets", IEEE Trans.
/// AES 6(4), 1970.
MotionModel singer(double tau, double sigma, double speed);

/// Position is an unknown constant plus a Matérn process (ν = 5/2): three states and the constant. Its covariance is
/// σ²(1 + √5 r + 5r²/3)e^{−√5 r} with r = |t|/ℓ. The standard deviation of velocity is speed = σ√(5/3)/ℓ.
/// @param ell s; @param speed m/s, both > 0
MotionModel matern52(double ell, double speed);

/// Position is an unknown constant plus a Gaussian process with covariance σ² e^{−r²/2}, r = |t|/ℓ. The standard
/// deviation of velocity is speed = σ/ℓ. Six states and the constant: Taylor's polynomial of order 6 in ω² approximates
/// the reciprocal of the spectrum, and is factored. J. Hartikainen, S. Särkkä, "Kalman filtering and smoothing
/// solutions to temporal Gaussian process regression models", MLSP 2010. @param ell s; @param speed m/s, both > 0
MotionModel squared_exponential(double ell, double speed);

/// A discrete step: s ← Φ s, P ← Φ P Φᵀ + Q.
struct ModelStep {
  ModelMatrix phi;
  ModelMatrix q;
};

/// Returns Φ = e^{F dt} and Q = ∫₀^dt e^{Fu} D e^{Fᵀu} du, by Taylor's series on dt/2^k and doubling, to 1e-12 of their
/// entries' natural scales. Two steps equal one step of their sum. Some 3 µs for order 7. @param dt s, ≥ 0
ModelStep model_step(const MotionModel& model, double dt);

}  // namespace tern
