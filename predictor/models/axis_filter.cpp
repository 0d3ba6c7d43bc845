#include "predictor/models/axis_filter.h"

#include <algorithm>

namespace tern {

void AxisFilter::predict(double dt, double q) {
  x += v * dt;
  xx += dt * (2.0 * xv + dt * (vv + q * dt / 3.0));
  xv += dt * (vv + q * dt / 2.0);
  vv += q * dt;
}

void AxisFilter::update(double z, double r) {
  const double s = xx + std::max(r, kMinVariance);
  const double gain_x = xx / s;
  const double gain_v = xv / s;
  const double innovation = z - x;
  x += gain_x * innovation;
  v += gain_v * innovation;
  vv -= gain_v * xv;
  xv -= gain_x * xv;
  xx -= gain_x * xx;
}

Fit fit(const Vec3& x, const Vec3& variance, const Vec3& z, const Vec3& r) {
  const Vec3 s = variance + r.cwiseMax(kMinVariance);
  return {s, ((z - x).array().square() / s.array()).sum()};
}

Box gate_box(const Vec3& x, const Vec3& variance, double gate, const Vec3& r) {
  constexpr double kRounding = 1.0 + 1e-9;  // of some ten operations at 1e-16 each
  return box_around(x, kRounding * (gate * (variance + r.cwiseMax(kMinVariance))).cwiseSqrt());
}

}  // namespace tern
