#include "tools/audit/cubic.h"

#include <algorithm>

namespace tern::audit {
namespace {

using Bernstein = std::array<double, 4>;

Bernstein bernstein_of(const Cubic& cubic, double a, double b) {
  const Cubic local = cubic.shifted(a);
  const double h = b - a;
  const double c1 = local.c[1] * h, c2 = local.c[2] * h * h, c3 = local.c[3] * h * h * h;
  return {local.c[0], local.c[0] + c1 / 3.0, local.c[0] + (2.0 * c1 + c2) / 3.0, local.c[0] + c1 + c2 + c3};
}

/// Bisects by de Casteljau's algorithm.
std::array<Bernstein, 2> halves(const Bernstein& b) {
  const double m01 = 0.5 * (b[0] + b[1]), m12 = 0.5 * (b[1] + b[2]), m23 = 0.5 * (b[2] + b[3]);
  const double l = 0.5 * (m01 + m12), r = 0.5 * (m12 + m23), middle = 0.5 * (l + r);
  return {Bernstein{b[0], m01, l, middle}, Bernstein{middle, r, m23, b[3]}};
}

/// Returns an upper bound of the values. It is at most `tolerance` above `attained`, which is raised to the largest
/// value seen.
double upper_bound(const Bernstein& b, double& attained, double tolerance, int depth) {
  constexpr int kDeepest = 40;
  attained = std::max({attained, b[0], b[3]});
  const double bound = std::max({b[0], b[1], b[2], b[3]});
  if (bound <= attained + tolerance || depth == kDeepest) return bound;
  const auto [left, right] = halves(b);
  const double first = upper_bound(left, attained, tolerance, depth + 1);
  return std::max(first, upper_bound(right, attained, tolerance, depth + 1));
}

/// Returns knot i of a clamped uniform cubic spline of `intervals` intervals, in units of its interval.
double knot(int i, int intervals) { return static_cast<double>(std::clamp(i - 3, 0, intervals)); }

/// A spline or one of its derivatives. Its knots are those of the cubic, from index `first` on.
struct Spline {
  Points q;
  int degree = 3, first = 0, intervals = 0;

  [[nodiscard]] double tau(int i) const { return knot(i + first, intervals); }
  [[nodiscard]] Spline derivative() const {
    Spline d{Points(3, q.cols() - 1), degree - 1, first + 1, intervals};
    for (int i = 0; i < d.q.cols(); ++i)
      d.q.col(i) = degree * (q.col(i + 1) - q.col(i)) / (tau(i + degree + 1) - tau(i + 1));
    return d;
  }
  /// Returns the value at u in the knot span [j, j + 1], by corner cutting.
  [[nodiscard]] Vec3 at(int j, double u) const {
    Points d = q.middleCols(j, degree + 1);
    for (int level = 1; level <= degree; ++level) {
      for (int i = degree; i >= level; --i) {
        const double low = tau(j + i), high = tau(j + i + degree + 1 - level);
        const double share = (u - low) / (high - low);
        d.col(i) = (1.0 - share) * d.col(i - 1) + share * d.col(i);
      }
    }
    return d.col(degree);
  }
};

}  // namespace

Cubic Cubic::shifted(double t0) const {
  return {{(*this)(t0), (3.0 * c[3] * t0 + 2.0 * c[2]) * t0 + c[1], 3.0 * c[3] * t0 + c[2], c[3]}};
}

Enclosure enclose(const Cubic& cubic, double a, double b, double tolerance) {
  const Bernstein up = bernstein_of(cubic, a, b);
  const Bernstein down{-up[0], -up[1], -up[2], -up[3]};
  double highest = up[0];
  double lowest = down[0];
  const double high = upper_bound(up, highest, tolerance, 0);
  return {-upper_bound(down, lowest, tolerance, 0), high};
}

Vec3 Curve::derivative(int order, double s) const {
  Vec3 value;
  for (int k = 0; k < 3; ++k) {
    Cubic d = axis[idx(k)];
    for (int i = 0; i < order; ++i) d = d.derivative();
    value[k] = d(s);
  }
  return value;
}

Cubic Curve::along(const Vec3& n) const {
  Cubic sum;
  for (std::size_t i = 0; i < 4; ++i) sum.c[i] = n.x() * axis[0].c[i] + n.y() * axis[1].c[i] + n.z() * axis[2].c[i];
  return sum;
}

Curve Curve::cut(UTime later, UTime end) const {
  Curve part{later, end, {}};
  for (std::size_t k = 0; k < 3; ++k) part.axis[k] = axis[k].shifted((later - from).seconds());
  return part;
}

Curve stationary_curve(const Vec3& p, UTime from, UTime to) {
  return {from, to, {Cubic{{p.x()}}, Cubic{{p.y()}}, Cubic{{p.z()}}}};
}

Box enclose(const Curve& curve, double a, double b, double tolerance) {
  Vec3 low, high;
  for (int k = 0; k < 3; ++k) {
    const Enclosure e = enclose(curve.axis[idx(k)], a, b, tolerance);
    low[k] = e.low, high[k] = e.high;
  }
  return {low, high};
}

Eigen::Matrix<double, 3, 4> bernstein_points(const Curve& curve, double a, double b) {
  Eigen::Matrix<double, 3, 4> points;
  for (int k = 0; k < 3; ++k) {
    const Bernstein row = bernstein_of(curve.axis[idx(k)], a, b);
    points.row(k) << row[0], row[1], row[2], row[3];
  }
  return points;
}

std::vector<Curve> curves_of(const TimedSpline& spline) {
  const int intervals = static_cast<int>(spline.control_points.cols()) - 3;
  const double dt = spline.interval.seconds();
  const Spline position{spline.control_points, 3, 0, intervals};
  const Spline velocity = position.derivative();
  const Spline acceleration = velocity.derivative();
  const Spline jerk = acceleration.derivative();
  std::vector<Curve> curves;
  for (int j = 0; j < intervals; ++j) {
    Curve curve{spline.start + spline.interval * j, spline.start + spline.interval * (j + 1), {}};
    const Vec3 p = position.at(j, j);
    const Vec3 v = velocity.at(j, j) / dt;
    const Vec3 a = acceleration.at(j, j) / (dt * dt);
    const Vec3 b = jerk.at(j, j) / (dt * dt * dt);
    for (int k = 0; k < 3; ++k) curve.axis[idx(k)].c = {p[k], v[k], a[k] / 2.0, b[k] / 6.0};
    curves.push_back(curve);
  }
  return curves;
}

std::vector<Curve> curves_of(const PiecewiseCubic& motion) {
  std::vector<Curve> curves;
  UTime from = motion.start;
  for (const CubicPiece& piece : motion.pieces) {
    Curve curve{from, from + piece.duration, {}};
    const PowerCubic& c = piece.coefficients;
    for (int k = 0; k < 3; ++k) curve.axis[idx(k)].c = {c(k, 3), c(k, 2), c(k, 1), c(k, 0)};
    curves.push_back(curve);
    from = curve.to;
  }
  return curves;
}

Curve hermite(UTime from, const Vec3& p0, const Vec3& v0, UTime to, const Vec3& p1, const Vec3& v1) {
  Curve curve{from, to, {}};
  const double h = curve.length_s();
  for (int k = 0; k < 3; ++k) {
    const double slope = (p1[k] - p0[k]) / h;
    curve.axis[idx(k)].c = {p0[k], v0[k], (3.0 * slope - 2.0 * v0[k] - v1[k]) / h,
                            (v0[k] + v1[k] - 2.0 * slope) / (h * h)};
  }
  return curve;
}

MotionSample motion_at(const std::vector<Curve>& curves, UTime t) {
  if (t >= curves.back().to)
    return {curves.back().p(curves.back().length_s()), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const auto next = std::ranges::upper_bound(curves, t, {}, &Curve::from);
  const Curve& curve = next == curves.begin() ? curves.front() : *std::prev(next);
  const double s = std::max(0.0, (t - curve.from).seconds());
  return {curve.p(s), curve.v(s), curve.a(s), curve.j(s)};
}

}  // namespace tern::audit
