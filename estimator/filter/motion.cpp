#include "estimator/filter/motion.h"

#include "estimator/filter/rotation.h"

namespace tern {
namespace {

using Eigen::Matrix3d;

template <class Matrix>
auto block(Matrix& M, int row, int column) {
  return M.template block<3, 3>(row, column);
}

}  // namespace

NavState moved(const NavState& state, const ImuStep& step, double gravity) {
  const double h = step.h;
  const Vec3 g(0.0, 0.0, -gravity), a = step.force - state.accel_bias;
  const RotationIntegrals turn = rotation_integrals((step.rate - state.gyro_bias) * h);
  NavState next = state;
  next.R = orthonormal(state.R * turn.exp);
  next.v = state.v + g * h + state.R * (turn.first * a) * h;
  next.p = state.p + state.v * h + g * (0.5 * h * h) + state.R * (turn.second * a) * (h * h);
  return next;
}

ErrorTransition error_transition(const NavState& half, const ImuStep& step, const ImuNoise& noise, double gravity) {
  const double h = step.h, h2 = 0.5 * h * h;
  const Matrix3d one = Matrix3d::Identity(), g = skew(Vec3(0.0, 0.0, -gravity)), P = skew(half.p), V = skew(half.v);
  const Matrix3d &R = half.R, PR = P * R, VR = V * R;

  ErrorTransition out{NavMatrix::Identity(), NavMatrix::Zero()};
  NavMatrix& Phi = out.Phi;
  block(Phi, kTheta, kErrorBg) = -R * h;
  block(Phi, kErrorP, kTheta) = g * h2;
  block(Phi, kErrorP, kErrorV) = one * h;
  block(Phi, kErrorP, kErrorBg) = -PR * h - VR * h2;
  block(Phi, kErrorP, kErrorBa) = -R * h2;
  block(Phi, kErrorV, kTheta) = g * h;
  block(Phi, kErrorV, kErrorBg) = -VR * h - g * R * h2;
  block(Phi, kErrorV, kErrorBa) = -R * h;

  // R Rᵀ = 1, so the noises need no rotation.
  const double gyro = (noise.gyro * noise.gyro + step.extra_rate * step.extra_rate * h) * h;
  const double accel = (noise.accel * noise.accel + step.extra_force * step.extra_force * h) * h;
  NavMatrix& Q = out.Q;
  block(Q, kTheta, kTheta) = gyro * one;
  block(Q, kErrorP, kTheta) = gyro * P;
  block(Q, kTheta, kErrorP) = -gyro * P;
  block(Q, kErrorV, kTheta) = gyro * V;
  block(Q, kTheta, kErrorV) = -gyro * V;
  block(Q, kErrorP, kErrorP) = -gyro * P * P;
  block(Q, kErrorV, kErrorP) = -gyro * V * P;
  block(Q, kErrorP, kErrorV) = -gyro * P * V;
  block(Q, kErrorV, kErrorV) = accel * one - gyro * V * V;
  block(Q, kErrorBg, kErrorBg) = noise.gyro_walk * noise.gyro_walk * h * one;
  block(Q, kErrorBa, kErrorBa) = noise.accel_walk * noise.accel_walk * h * one;
  return out;
}

NavState corrected(const NavState& state, const NavVector& error) {
  const RotationIntegrals turn = rotation_integrals(error.segment<3>(kTheta));
  NavState out;
  out.R = orthonormal(turn.exp * state.R);
  out.p = turn.exp * state.p + turn.first * error.segment<3>(kErrorP);
  out.v = turn.exp * state.v + turn.first * error.segment<3>(kErrorV);
  out.gyro_bias = state.gyro_bias + error.segment<3>(kErrorBg);
  out.accel_bias = state.accel_bias + error.segment<3>(kErrorBa);
  return out;
}

NavVector error_of(const NavState& estimate, const NavState& truth) {
  const Vec3 theta = log_rotation(truth.R * estimate.R.transpose());
  const RotationIntegrals turn = rotation_integrals(theta);
  const Matrix3d J = turn.first.inverse();
  NavVector error;
  error << theta, J * (truth.p - turn.exp * estimate.p), J * (truth.v - turn.exp * estimate.v),
      truth.gyro_bias - estimate.gyro_bias, truth.accel_bias - estimate.accel_bias;
  return error;
}

NavMatrix ordinary_error_jacobian(const NavState& state) {
  NavMatrix J = NavMatrix::Identity();
  block(J, kErrorP, kTheta) = -skew(state.p);
  block(J, kErrorV, kTheta) = -skew(state.v);
  return J;
}

}  // namespace tern
