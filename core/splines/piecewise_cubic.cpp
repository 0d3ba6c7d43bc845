#include "core/splines/piecewise_cubic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace tern {
namespace {

// An interval is a whole number of microseconds if it differs from one by at most this, µs.
constexpr double kWholeMicrosecondTolerance = 1e-3;

// Returns the roots of a t² + b t + c = 0 without cancellation: the larger one first, the other from the product. A
// root that does not exist is NaN, and every comparison with it fails. Rounding may lose double roots; they are
// inflections, not extrema.
std::array<double, 2> quadratic_roots(double a, double b, double c) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) return {kNone, kNone};
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  return {q / a, c / q};
}

void require_pieces(const PiecewiseCubic& motion) {
  if (motion.pieces.empty()) throw std::invalid_argument("a piecewise cubic without pieces");
}

double coordinate_of(const PowerCubic& c, double t, int axis) {
  return ((c(axis, 0) * t + c(axis, 1)) * t + c(axis, 2)) * t + c(axis, 3);
}

Vec3 velocity(const PowerCubic& c, double t) { return (3.0 * c.col(0) * t + 2.0 * c.col(1)) * t + c.col(2); }

// Returns the coefficients of s ↦ c(t0 + s).
PowerCubic shifted(const PowerCubic& c, double t0) {
  PowerCubic r;
  r.col(0) = c.col(0);
  r.col(1) = 3.0 * c.col(0) * t0 + c.col(1);
  r.col(2) = velocity(c, t0);
  r.col(3) = position_of(c, t0);
  return r;
}

// Returns the coefficients of s ↦ c(s·k).
PowerCubic scaled(const PowerCubic& c, double k) {
  PowerCubic r = c;
  r.col(0) *= k * k * k;
  r.col(1) *= k * k;
  r.col(2) *= k;
  return r;
}

}  // namespace

UTime PiecewiseCubic::end() const {
  require_pieces(*this);
  UTime t = start;
  for (const CubicPiece& piece : pieces) t = t + piece.duration;
  return t;
}

PiecewiseCubic::Located PiecewiseCubic::locate(UTime t) const {
  require_pieces(*this);
  Located at{0, start};
  while (at.index + 1 < pieces.size() && t >= at.start + pieces[at.index].duration) {
    at.start = at.start + pieces[at.index].duration;
    ++at.index;
  }
  return at;
}

MotionSample PiecewiseCubic::sample(UTime t) const {
  const Located at = locate(t);
  return sample_cubic(pieces[at.index].coefficients, (t - at.start).seconds());
}

MotionSample sample_cubic(const PowerCubic& c, double tau_s) {
  return {position_of(c, tau_s), velocity(c, tau_s), 6.0 * c.col(0) * tau_s + 2.0 * c.col(1), 6.0 * c.col(0)};
}

Vec3 max_abs_velocity(const PowerCubic& c, double t0_s, double t1_s) {
  Vec3 largest = velocity(c, t0_s).cwiseAbs().cwiseMax(velocity(c, t1_s).cwiseAbs());
  for (int axis = 0; axis < 3; ++axis) {
    const double vertex = -c(axis, 1) / (3.0 * c(axis, 0));
    if (vertex > t0_s && vertex < t1_s) largest[axis] = std::max(largest[axis], std::abs(velocity(c, vertex)[axis]));
  }
  return largest;
}

Vec3 max_abs_acceleration(const PowerCubic& c, double t0_s, double t1_s) {
  const auto a = [&c](double t) -> Vec3 { return 6.0 * c.col(0) * t + 2.0 * c.col(1); };
  return a(t0_s).cwiseAbs().cwiseMax(a(t1_s).cwiseAbs());
}

Box cubic_bounds(const PowerCubic& c, double t0_s, double t1_s) {
  Box box(position_of(c, t0_s));
  box.extend(position_of(c, t1_s));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double root : quadratic_roots(3.0 * c(axis, 0), 2.0 * c(axis, 1), c(axis, 2))) {
      if (!(root > t0_s && root < t1_s)) continue;
      const double p = coordinate_of(c, root, axis);
      box.min()[axis] = std::min(box.min()[axis], p);
      box.max()[axis] = std::max(box.max()[axis], p);
    }
  }
  return box;
}

PowerCubic reparametrized(const PowerCubic& c, double t0_s, double t1_s) {
  return scaled(shifted(c, t0_s), t1_s - t0_s);
}

CubicPiece hermite_piece(const MotionSample& from, const MotionSample& to, Duration duration) {
  if (duration <= Duration{}) {
    throw std::invalid_argument("a piece of " + std::to_string(duration.us) + " us, not positive");
  }
  const double h = duration.seconds();
  const Vec3 slope = (to.p - from.p) / h;
  CubicPiece piece;
  piece.duration = duration;
  piece.coefficients.col(0) = (from.v + to.v - 2.0 * slope) / (h * h);
  piece.coefficients.col(1) = (3.0 * slope - 2.0 * from.v - to.v) / h;
  piece.coefficients.col(2) = from.v;
  piece.coefficients.col(3) = from.p;
  return piece;
}

PiecewiseCubic hermite_fit(UTime start, Duration piece, int pieces, const MotionFunction& motion) {
  if (pieces < 1) throw std::invalid_argument("a fit of " + std::to_string(pieces) + " pieces");
  PiecewiseCubic fit{start, {}};
  fit.pieces.reserve(static_cast<std::size_t>(pieces));
  MotionSample from = motion(Duration{});
  for (int k = 1; k <= pieces; ++k) {
    const MotionSample to = motion(piece * k);
    fit.pieces.push_back(hermite_piece(from, to, piece));
    from = to;
  }
  return fit;
}

double hermite_error_bound(double h_s, double max_fourth_derivative) {
  return h_s * h_s * h_s * h_s / 384.0 * max_fourth_derivative;
}

PiecewiseCubic remaining_motion(const ClampedSpline& spline, UTime spline_start, UTime from) {
  const Duration interval = Duration::from_seconds(spline.interval_s());
  if (std::abs(spline.interval_s() * 1e6 - static_cast<double>(interval.us)) > kWholeMicrosecondTolerance ||
      interval <= Duration{}) {
    throw std::invalid_argument("an interval of " + std::to_string(spline.interval_s() * 1e6) +
                                " us is not a whole number of us");
  }
  const Duration passed = from - spline_start;
  if (passed < Duration{} || passed >= interval * spline.intervals()) {
    throw std::invalid_argument("no motion remains " + std::to_string(passed.us) +
                                " us after the start of a spline of " +
                                std::to_string((interval * spline.intervals()).us) + " us");
  }
  const int first = static_cast<int>(passed.us / interval.us);
  const Duration inside = passed - interval * first;
  PiecewiseCubic rest{from, {}};
  rest.pieces.reserve(static_cast<std::size_t>(spline.intervals() - first));
  for (int j = first; j < spline.intervals(); ++j) {
    rest.pieces.push_back({interval, scaled(spline.power(j), 1.0 / interval.seconds())});
  }
  CubicPiece& cut = rest.pieces.front();
  cut = {interval - inside, shifted(cut.coefficients, inside.seconds())};
  return rest;
}

}  // namespace tern
