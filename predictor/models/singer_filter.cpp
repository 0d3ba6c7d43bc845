#include "predictor/models/singer_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

// Below this s/τ the closed form of g₁ loses digits and its series to the fourth order is exact to 1e-12.
constexpr double kSeriesBelow = 1e-2;

// Gauss-Legendre nodes and weights of order 8 on [−1, 1] (M. Abramowitz, I. A. Stegun, table 25.4).
constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};

Eigen::Vector3d impulse_response(double tau, double s) {
  if (tau <= 0.0) return {s, 1.0, 0.0};
  const double u = s / tau;
  const double fall = -std::expm1(-u);
  const double first = u < kSeriesBelow ? u * u * (0.5 - u * (1.0 / 6.0 - u * (1.0 / 24.0 - u / 120.0))) : u - fall;
  return {tau * tau * first, tau * fall, 1.0 - fall};
}

}  // namespace

Transition transition(const AccelerationModel& model, double dt) {
  const Eigen::Vector3d g = impulse_response(model.time_s, dt);
  Transition step;
  step.phi << 1.0, dt, model.time_s > 0.0 ? g[0] : 0.0,  //
      0.0, 1.0, model.time_s > 0.0 ? g[1] : 0.0,         //
      0.0, 0.0, g[2];
  step.q.setZero();
  for (std::size_t k = 0; k < kNodes.size(); ++k) {
    for (const double node : {kNodes[k], -kNodes[k]}) {
      const Eigen::Vector3d at = impulse_response(model.time_s, 0.5 * dt * (1.0 + node));
      step.q += 0.5 * dt * kWeights[k] * at * at.transpose();
    }
  }
  step.q *= model.sigma * model.sigma * (model.time_s > 0.0 ? 2.0 / model.time_s : 1.0);
  return step;
}

void SingerFilter::predict(const Transition& step) {
  state = step.phi * state;
  const Eigen::Matrix3d moved = step.phi * covariance * step.phi.transpose();
  covariance = moved + step.q;
}

void SingerFilter::update(double z, double r) {
  const double s = covariance(0, 0) + std::max(r, kLeastVariance);
  const Eigen::Vector3d column = covariance.col(0);
  state += column * ((z - state[0]) / s);
  covariance -= column * column.transpose() / s;
}

double SingerFilter::distance2(double z, double r) const {
  const double innovation = z - state[0];
  return innovation * innovation / (covariance(0, 0) + std::max(r, kLeastVariance));
}

}  // namespace tern
