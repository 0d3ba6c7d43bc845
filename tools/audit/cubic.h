// The auditor's own arithmetic: cubics with proven bounds, and splines converted to cubics by de Boor's algorithm.
//
// It shares no formula with core/splines, so an error there shows as a difference here.
#pragma once

#include <array>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/splines/piecewise_cubic.h"
#include "core/world/vehicle.h"

namespace tern::audit {

/// The polynomial c[0] + c[1] t + c[2] t² + c[3] t³.
struct Cubic {
  std::array<double, 4> c{};

  [[nodiscard]] double operator()(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
  [[nodiscard]] Cubic derivative() const { return {{c[1], 2.0 * c[2], 3.0 * c[3], 0.0}}; }
  /// Returns the polynomial s ↦ this(t0 + s).
  [[nodiscard]] Cubic shifted(double t0) const;
};

/// Contains every value. Each end is within a stated tolerance of a value that is attained.
struct Enclosure {
  double low = 0.0, high = 0.0;
};

/// Encloses a cubic on [a, b] by its Bernstein coefficients: they bound the curve, since it is their convex
/// combination. Bisection converges quadratically. The enclosure is proven up to rounding (1e-15 of the coefficients).
Enclosure enclose(const Cubic& cubic, double a, double b, double tolerance);

/// A motion in W over [from, to]. The parameter of each axis is seconds since `from`.
struct Curve {
  UTime from, to;
  std::array<Cubic, 3> axis;

  [[nodiscard]] double length_s() const { return (to - from).seconds(); }
  [[nodiscard]] Vec3 p(double s) const { return {axis[0](s), axis[1](s), axis[2](s)}; }
  [[nodiscard]] Vec3 v(double s) const { return derivative(1, s); }
  [[nodiscard]] Vec3 a(double s) const { return derivative(2, s); }
  [[nodiscard]] Vec3 j(double s) const { return derivative(3, s); }
  /// Returns n · p(s) as a cubic.
  [[nodiscard]] Cubic along(const Vec3& n) const;
  /// Returns the same motion over [later, end].
  [[nodiscard]] Curve cut(UTime later, UTime end) const;

 private:
  [[nodiscard]] Vec3 derivative(int order, double s) const;
};

/// Returns a motion that stays at p.
Curve stationary_curve(const Vec3& p, UTime from = {}, UTime to = {});

/// Returns a box that contains the curve over [a, b] seconds. Each face is within `tolerance` of the curve.
Box enclose(const Curve& curve, double a, double b, double tolerance);

/// Returns four points whose convex hull contains the curve over [a, b] seconds.
Eigen::Matrix<double, 3, 4> bernstein_points(const Curve& curve, double a, double b);

/// Converts a clamped uniform cubic B-spline, one curve per interval. De Boor's algorithm gives value and derivatives
/// at the start of an interval. Derivative splines are q'_i = k (q_{i+1} − q_i)/(τ_{i+k+1} − τ_{i+1}). Taylor's
/// formula, exact for a cubic, gives the coefficients.
std::vector<Curve> curves_of(const TimedSpline& spline);

/// Converts a track's motion, one curve per piece.
std::vector<Curve> curves_of(const PiecewiseCubic& motion);

/// Returns the Hermite cubic through these positions and velocities.
Curve hermite(UTime from, const Vec3& p0, const Vec3& v0, UTime to, const Vec3& p1, const Vec3& v1);

/// Returns the motion at t. It is at rest after the last curve, and the first state before the first curve.
MotionSample motion_at(const std::vector<Curve>& curves, UTime t);

}  // namespace tern::audit
