// Motion of one axis as a linear stochastic differential equation, and its exact discretisation.
#pragma once

#include <Eigen/Core>

namespace tern {

inline constexpr int kMaxOrder = 7;
/// Square matrices and columns of a model's order, without heap memory.
using ModelMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxOrder, kMaxOrder>;

using ModelVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxOrder, 1>;

enum class MotionFamily { ConstantVelocity, Singer, Matern52, SquaredExponential };

/// ds = F s dt + dw with E[dw dwᵀ] = D dt. s_0 is the position (m) and s_1 the velocity (m/s) in every model. Nothing
/// is known of the position before it is first measured, as z with variance r: then s ~ N(z u, P_0 + r u uᵀ).
struct MotionModel {
  MotionFamily family = MotionFamily::ConstantVelocity;
  double time_s = 0.0;     ///< how long the model remembers: τ of Singer, ℓ of a Gaussian process; 0: for ever
  double amplitude = 1.0;  ///< as its maker says
  double rate = 0.0;       ///< 1/s, an upper bound of how fast its transitions change; 0: F is nilpotent
  ModelMatrix drift;       ///< F, of order 2 … kMaxOrder
  ModelMatrix diffusion;   ///< D
  ModelMatrix prior;       ///< P_0: of all else, where the position is known
  ModelVector shift;       ///< u: s + c u is the same motion, c m farther along the axis

  [[nodiscard]] int order() const { return static_cast<int>(drift.rows()); }
};

/// Velocity is a Wiener process. @param q √ of the spectral density of acceleration, m/s^1.5, > 0; @param speed
/// standard deviation of velocity before anything was measured, m/s, > 0.
MotionModel constant_velocity(double q, double speed);

/// Acceleration is a stationary Gauss-Markov process of standard deviation `sigma` (m/s²) that lasts tau (s): R. A.
/// Singer, "Estimating optimal tracking filter performance for manned maneuvering targets", IEEE Trans. AES 6(4), 1970.
MotionModel singer(double tau, double sigma, double speed);

/// Position is an unknown constant and a Gaussian process of covariance σ²(1 + √5 r + 5r²/3)e^{−√5 r}, r = |t|/ℓ
/// (Matérn, ν = 5/2): three states and the constant. Speed has the deviation σ√(5/3)/ℓ. @param ell s; @param speed m/s,
/// both > 0.
MotionModel matern52(double ell, double speed);

/// Position is an unknown constant and a Gaussian process of covariance σ² e^{−r²/2}, r = |t|/ℓ, speed having the
/// deviation σ/ℓ. Six states and the constant: the reciprocal of its spectrum by Taylor's polynomial of order 6 in ω²,
/// factored (J. Hartikainen, S. Särkkä, "Kalman filtering and smoothing solutions to temporal Gaussian process
/// regression models", MLSP 2010). @param ell s; @param speed m/s, both > 0.
MotionModel squared_exponential(double ell, double speed);

/// s ← Φ s, P ← Φ P Φᵀ + Q.
struct ModelStep {
  ModelMatrix phi;
  ModelMatrix q;
};

/// Φ = e^{F dt}, Q = ∫₀^dt e^{Fu} D e^{Fᵀu} du, by Taylor's series on dt/2^k and doubling, to 1e-12 of their entries'
/// natural scales. Two steps make the same as one of their sum. @param dt s, ≥ 0. Some 3 µs for order 7.
ModelStep model_step(const MotionModel& model, double dt);

}  // namespace tern
