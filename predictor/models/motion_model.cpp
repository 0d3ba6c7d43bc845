#include "predictor/models/motion_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tern {
namespace {

// Σ_k (ω²/2)^k/k! up to k = 6 is |A(iω)|²/(2⁶·6!) with A(s) = s⁶ + Σ c_i s^i, all of its roots on the left.
constexpr int kExponentialOrder = 6;
constexpr std::array<double, kExponentialOrder> kExponential{214.6625258399799,  443.7119618029668, 404.9153534525785,
                                                             210.18825318674948, 65.98646122880892, 11.998871716024713};
constexpr double kExponentialDensity = 46080.0 * 2.5066282746310002;  // 2⁶·6!·√(2π)
constexpr double kExponentialRate = 6.0;                              // of the scaled companion matrix, per ℓ

// Taylor's series at ‖F‖h ≤ kTaylorStep: the first omitted term is below 1e-15.
constexpr int kTaylorTerms = 13;
constexpr double kTaylorStep = 0.5;
// After this many doublings a stationary process has forgotten its start.
constexpr int kStationaryDoublings = 12;

template <int N>
ModelStep step_of(const MotionModel& model, double dt) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const int doublings =
      model.rate * dt > kTaylorStep ? static_cast<int>(std::ceil(std::log2(model.rate * dt / kTaylorStep))) : 0;
  const double h = std::ldexp(dt, -doublings);
  const Matrix f = model.drift;
  Matrix phi = Matrix::Identity(), power = phi;
  Matrix moved = model.diffusion, q = Matrix::Zero();
  double weight = h;  // h^{k+1}/(k+1)!
  for (int k = 1; k <= kTaylorTerms; ++k) {
    power = (h / k) * (f * power).eval();
    phi += power;
    q += weight * moved;
    const Matrix half = f * moved;
    moved = half + half.transpose();
    weight *= h / (k + 1);
  }
  for (int k = 0; k < doublings; ++k) {
    q += (phi * q * phi.transpose()).eval();
    phi = (phi * phi).eval();
  }
  return {phi, q};
}

// The model (position, its derivatives, the constant) of a stationary process with this companion polynomial and
// white-noise density: ṡ_{n−1} = −Σ c_i s_i, where s_0 is the position less the constant.
MotionModel around_a_constant(MotionFamily family, double ell, double speed, double rate, double density,
                              const Eigen::VectorXd& polynomial) {
  const Eigen::Index n = polynomial.size();
  MotionModel model;
  model.family = family;
  model.time_s = ell;
  model.amplitude = speed;
  model.rate = rate / ell;
  model.drift.setZero(n, n);
  model.diffusion.setZero(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) model.drift(i, i + 1) = 1.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    model.drift(n - 1, i) = -polynomial[i] * std::pow(ell, static_cast<double>(i - n));
  }
  model.diffusion(n - 1, n - 1) = density;
  ModelStep step = model_step(model, ell);
  for (int k = 0; k < kStationaryDoublings; ++k) {
    step.q += (step.phi * step.q * step.phi.transpose()).eval();
    step.phi = (step.phi * step.phi).eval();
  }
  const double scale = speed * speed / step.q(1, 1);
  const ModelMatrix stationary = scale * step.q;
  const double restoring = -model.drift(n - 1, 0);
  model.drift.conservativeResizeLike(ModelMatrix::Zero(n + 1, n + 1));
  model.drift(n - 1, n) = restoring;
  model.diffusion.setZero(n + 1, n + 1);
  model.diffusion(n - 1, n - 1) = scale * density;
  // The constant is the position less the process.
  model.prior.setZero(n + 1, n + 1);
  model.prior.topLeftCorner(n, n) = stationary;
  model.prior.col(n).head(n) = -stationary.col(0);
  model.prior.row(n) = model.prior.col(n).transpose();
  model.prior(n, n) = stationary(0, 0);
  model.prior.row(0).setZero();
  model.prior.col(0).setZero();
  model.shift.setZero(n + 1);
  model.shift[0] = model.shift[n] = 1.0;
  return model;
}

}  // namespace

MotionModel constant_velocity(double q, double speed) {
  MotionModel model;
  model.family = MotionFamily::ConstantVelocity;
  model.amplitude = q;
  model.drift.setZero(2, 2);
  model.drift(0, 1) = 1.0;
  model.diffusion.setZero(2, 2);
  model.diffusion(1, 1) = q * q;
  model.prior.setZero(2, 2);
  model.prior(1, 1) = speed * speed;
  model.shift = ModelVector::Unit(2, 0);
  return model;
}

MotionModel singer(double tau, double sigma, double speed) {
  MotionModel model;
  model.family = MotionFamily::Singer;
  model.time_s = tau;
  model.amplitude = sigma;
  model.rate = std::max(1.0, 1.0 / tau);
  model.drift.setZero(3, 3);
  model.drift(0, 1) = model.drift(1, 2) = 1.0;
  model.drift(2, 2) = -1.0 / tau;
  model.diffusion.setZero(3, 3);
  model.diffusion(2, 2) = 2.0 * sigma * sigma / tau;
  model.prior.setZero(3, 3);
  model.prior(1, 1) = speed * speed;
  model.prior(2, 2) = sigma * sigma;
  model.shift = ModelVector::Unit(3, 0);
  return model;
}

MotionModel matern52(double ell, double speed) {
  const double lambda = std::sqrt(5.0);
  const Eigen::Vector3d polynomial(lambda * lambda * lambda, 3.0 * lambda * lambda, 3.0 * lambda);
  return around_a_constant(MotionFamily::Matern52, ell, speed, 2.0 * lambda, std::pow(ell, -5.0), polynomial);
}

MotionModel squared_exponential(double ell, double speed) {
  const Eigen::VectorXd polynomial = Eigen::Map<const Eigen::VectorXd>(kExponential.data(), kExponentialOrder);
  return around_a_constant(MotionFamily::SquaredExponential, ell, speed, kExponentialRate,
                           kExponentialDensity * std::pow(ell, 1.0 - 2.0 * kExponentialOrder), polynomial);
}

ModelStep model_step(const MotionModel& model, double dt) {
  switch (model.order()) {
    case 2: return step_of<2>(model, dt);
    case 3: return step_of<3>(model, dt);
    case 4: return step_of<4>(model, dt);
    case 6: return step_of<6>(model, dt);
    default: return step_of<kMaxOrder>(model, dt);
  }
}

}  // namespace tern
