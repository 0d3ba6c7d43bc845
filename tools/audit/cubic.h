// The auditor's own arithmetic: cubics with proven bounds, and splines turned into cubics by de Boor's algorithm.
//
// Nothing here comes from core/splines: an auditor that shared its formulas with the planner would share its mistakes.
#pragma once

#include <array>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/splines/piecewise_cubic.h"
#include "core/world/vehicle.h"

namespace tern::audit {

/// c[0] + c[1] t + c[2] t² + c[3] t³.
struct Cubic {
  std::array<double, 4> c{};

  [[nodiscard]] double operator()(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
  [[nodiscard]] Cubic derivative() const { return {{c[1], 2.0 * c[2], 3.0 * c[3], 0.0}}; }
  /// s ↦ this(t0 + s).
  [[nodiscard]] Cubic shifted(double t0) const;
};

/// All values lie in [low, high], and both ends are within a stated tolerance of values that are attained.
struct Enclosure {
  double low = 0.0, high = 0.0;
};

/// Encloses a cubic on [a, b]: its Bernstein coefficients bound it (they are averages of it and the curve is one of
/// theirs), and halving brings them to the curve quadratically. Proven but for rounding (1e-15 of the coefficients).
Enclosure enclose(const Cubic& cubic, double a, double b, double tolerance);

/// A motion in W over [from, to]; the axes' parameter is seconds since `from`.
struct Curve {
  UTime from, to;
  std::array<Cubic, 3> axis;

  [[nodiscard]] double length_s() const { return (to - from).seconds(); }
  [[nodiscard]] Vec3 p(double s) const { return {axis[0](s), axis[1](s), axis[2](s)}; }
  [[nodiscard]] Vec3 v(double s) const { return derivative(1, s); }
  [[nodiscard]] Vec3 a(double s) const { return derivative(2, s); }
  [[nodiscard]] Vec3 j(double s) const { return derivative(3, s); }
  /// n · p(s) as a cubic.
  [[nodiscard]] Cubic along(const Vec3& n) const;
  /// The same motion over [later, end].
  [[nodiscard]] Curve cut(UTime later, UTime end) const;

 private:
  [[nodiscard]] Vec3 derivative(int order, double s) const;
};

/// At p all the time.
Curve stationary_curve(const Vec3& p, UTime from = {}, UTime to = {});

/// Holds the curve over [a, b] seconds; each face is within `tolerance` of it.
Box enclose(const Curve& curve, double a, double b, double tolerance);

/// Four points whose hull holds the curve over [a, b] seconds.
Eigen::Matrix<double, 3, 4> bernstein_points(const Curve& curve, double a, double b);

/// The intervals of a clamped uniform cubic B-spline, one curve each. Value and derivatives at an interval's beginning
/// by de Boor's algorithm on the spline and on its derivative splines q'_i = k (q_{i+1} − q_i)/(τ_{i+k+1} − τ_{i+1}),
/// then Taylor's formula, exact for a cubic.
std::vector<Curve> curves_of(const TimedSpline& spline);

/// The pieces of a track's motion.
std::vector<Curve> curves_of(const PiecewiseCubic& motion);

/// The cubic that has these positions and velocities at its ends (Hermite).
Curve hermite(UTime from, const Vec3& p0, const Vec3& v0, UTime to, const Vec3& p1, const Vec3& v1);

/// The motion of a spline at t: at rest after its end; before its start its first state.
MotionSample motion_at(const std::vector<Curve>& curves, UTime t);

}  // namespace tern::audit
