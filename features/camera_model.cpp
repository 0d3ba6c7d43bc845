#include "features/camera_model.h"

#include <cmath>

namespace tern {
namespace {

using Eigen::Vector2d;

constexpr int kNewtonSteps = 20;
/// Of a normalized coordinate: 1e-6 pixels at a focal length of 1000 pixels.
constexpr double kConverged = 1e-9;
/// Coordinates x/z are of use up to this angle from the optical axis, rad: 86°.
constexpr double kWidestAngle = 1.5;

/// Distorted coordinates with their derivative by x and y.
struct Distorted {
  Vector2d at;
  Eigen::Matrix2d derivative;
};

Distorted radial_tangential(const std::array<double, 5>& c, const Vector2d& at) {
  const auto [k1, k2, p1, p2, k3] = c;
  const double x = at.x(), y = at.y(), s = at.squaredNorm();
  const double radial = 1.0 + s * (k1 + s * (k2 + s * k3));
  const double slope = k1 + s * (2.0 * k2 + s * 3.0 * k3);  // d radial / d s
  Distorted d;
  d.at = {x * radial + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x),
          y * radial + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y};
  const double mixed = 2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
  d.derivative << radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed,
      radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return d;
}

/// Whether the lens's model is still monotonic there: its derivative is positive definite.
bool is_monotonic(const Eigen::Matrix2d& derivative) {
  return derivative.determinant() > 0.0 && derivative.trace() > 0.0;
}

/// θ_d(θ) and its derivative.
std::pair<double, double> equidistant(const std::array<double, 5>& c, double theta) {
  const double s = theta * theta;
  return {theta * (1.0 + s * (c[0] + s * (c[1] + s * (c[2] + s * c[3])))),
          1.0 + s * (3.0 * c[0] + s * (5.0 * c[1] + s * (7.0 * c[2] + s * 9.0 * c[3])))};
}

std::optional<Vector2d> undo_radial_tangential(const std::array<double, 5>& c, const Vector2d& distorted) {
  Vector2d at = distorted;
  for (int k = 0; k < kNewtonSteps; ++k) {
    const Distorted d = radial_tangential(c, at);
    if (!is_monotonic(d.derivative)) return std::nullopt;
    const Vector2d miss = distorted - d.at;
    if (miss.norm() < kConverged) return at;
    Eigen::Matrix2d adjugate;
    adjugate << d.derivative(1, 1), -d.derivative(0, 1), -d.derivative(1, 0), d.derivative(0, 0);
    at += adjugate * miss / d.derivative.determinant();
  }
  return std::nullopt;
}

std::optional<Vector2d> undo_equidistant(const std::array<double, 5>& c, const Vector2d& distorted) {
  const double radius = distorted.norm();
  if (radius < kConverged) return distorted;
  double theta = radius;
  for (int k = 0; k < kNewtonSteps; ++k) {
    const auto [value, slope] = equidistant(c, theta);
    if (!(slope > 0.0)) return std::nullopt;
    if (std::abs(radius - value) < kConverged) {
      if (theta < 0.0 || theta > kWidestAngle) return std::nullopt;
      return std::tan(theta) / radius * distorted;
    }
    theta += (radius - value) / slope;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vector2d> CameraModel::pixel_of(const Vec3& direction) const {
  if (!(direction.z() > 0.0)) return std::nullopt;
  const Vector2d at = direction.head<2>() / direction.z();
  Vector2d distorted;
  if (lens == LensModel::RadialTangential) {
    const Distorted d = radial_tangential(coefficients, at);
    if (!is_monotonic(d.derivative)) return std::nullopt;
    distorted = d.at;
  } else {
    const double r = at.norm(), theta = std::atan(r);
    const auto [value, slope] = equidistant(coefficients, theta);
    if (!(slope > 0.0) || theta > kWidestAngle) return std::nullopt;
    distorted = r < kConverged ? at : Vector2d(value / r * at);
  }
  return Vector2d(fx * distorted.x() + cx, fy * distorted.y() + cy);
}

std::optional<Vector2d> CameraModel::coordinates_of(const Vector2d& pixel) const {
  const Vector2d distorted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  return lens == LensModel::RadialTangential ? undo_radial_tangential(coefficients, distorted)
                                             : undo_equidistant(coefficients, distorted);
}

}  // namespace tern
