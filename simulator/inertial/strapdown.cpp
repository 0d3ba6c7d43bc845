#include "simulator/inertial/strapdown.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "core/world/vehicle.h"

namespace tern {
namespace {

/// Below this angle (rad) the series are used: their next terms are below 1e-16.
constexpr double kSmall = 1e-2;

Mat3 cross_matrix(const Vec3& x) {
  Mat3 m;
  m << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return m;
}

/// Returns a I + b [φ]× + c [φ]×².
Mat3 combination(double a, double b, double c, const Vec3& phi) {
  const Mat3 k = cross_matrix(phi);
  return a * Mat3::Identity() + b * k + c * (k * k);
}

/// The coefficients of the series by t = θ²: sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³, (θ²/2 + cos θ − 1)/θ⁴.
struct Coefficients {
  double s1, s2, s3, s4;
};

Coefficients coefficients(double theta) {
  const double t = theta * theta;
  if (theta < kSmall) {
    return {1.0 - t / 6.0 + t * t / 120.0, 0.5 - t / 24.0 + t * t / 720.0, 1.0 / 6.0 - t / 120.0 + t * t / 5040.0,
            1.0 / 24.0 - t / 720.0 + t * t / 40320.0};
  }
  const double s = std::sin(theta), c = std::cos(theta);
  return {s / theta, (1.0 - c) / t, (theta - s) / (t * theta), (t / 2.0 + c - 1.0) / (t * t)};
}

}  // namespace

Mat3 rotation_exp(const Vec3& phi) {
  const Coefficients k = coefficients(phi.norm());
  return combination(1.0, k.s1, k.s2, phi);
}

Vec3 rotation_log(const Mat3& R) {
  const Eigen::AngleAxisd turn{Eigen::Quaterniond(R).normalized()};
  return turn.angle() * turn.axis();
}

InertialState strapdown(const InertialState& from, const InertialSample& sample, double h_s) {
  const Vec3 phi = h_s * sample.rate, gravity(0.0, 0.0, -kGravity);
  const Coefficients k = coefficients(phi.norm());
  const Vec3 gained = combination(1.0, k.s2, k.s3, phi) * sample.force;
  const Vec3 moved = combination(0.5, k.s3, k.s4, phi) * sample.force;
  InertialState to;
  to.p = from.p + h_s * from.v + h_s * h_s * (0.5 * gravity + from.R * moved);
  to.v = from.v + h_s * (gravity + from.R * gained);
  to.R = from.R * combination(1.0, k.s1, k.s2, phi);
  return to;
}

InertialSample sample_between(const InertialState& from, const InertialState& to, double h_s) {
  InertialSample sample;
  const Vec3 phi = rotation_log(from.R.transpose() * to.R);
  const Coefficients k = coefficients(phi.norm());
  const Vec3 mean = from.R.transpose() * ((to.v - from.v) / h_s + Vec3(0.0, 0.0, kGravity));
  sample.rate = phi / h_s;
  sample.force = combination(1.0, k.s2, k.s3, phi).inverse() * mean;
  return sample;
}

}  // namespace tern
