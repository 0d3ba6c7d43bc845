#include "core/splines/clamped_spline.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/splines/piecewise_cubic.h"

namespace tern {
namespace {

using Polynomial = Eigen::RowVector4d;  // u³ u² u 1

// (constant + slope·u)·p; p's own degree is at most 2 wherever this is used.
Polynomial times_linear(const Polynomial& p, double constant, double slope) {
  Polynomial product = constant * p;
  product.head<3>() += slope * p.tail<3>();
  return product;
}

// Rows: N_{j,3} … N_{j+3,3} on [τ_{j+3}, τ_{j+4}) = [j, j + 1).
Eigen::Matrix4d cox_de_boor(int intervals, int j) {
  const auto knot = [intervals](int i) { return static_cast<double>(std::clamp(i - 3, 0, intervals)); };
  const int span = j + 3;
  const double t0 = knot(span);
  // Row r is N_{j+r,k}; the extra row stays zero: N_{span+1,k} vanishes on this interval.
  Eigen::Matrix<double, 5, 4> n = Eigen::Matrix<double, 5, 4>::Zero();
  n(3, 3) = 1.0;
  for (int k = 1; k <= 3; ++k) {
    for (int i = span - k; i <= span; ++i) {
      const int r = i - j;
      const double rise = knot(i + k) - knot(i);
      const double fall = knot(i + k + 1) - knot(i + 1);
      Polynomial next = Polynomial::Zero();
      if (rise > 0.0) next += times_linear(n.row(r), (t0 - knot(i)) / rise, 1.0 / rise);
      if (fall > 0.0) next += times_linear(n.row(r + 1), (knot(i + k + 1) - t0) / fall, -1.0 / fall);
      n.row(r) = next;
    }
  }
  return n.topRows<4>();
}

[[noreturn]] void throw_interval(int j, int intervals) {
  throw std::out_of_range("interval " + std::to_string(j) + " of a spline with " + std::to_string(intervals) +
                          " intervals");
}

void require_interval_length(double interval_s) {
  if (!(interval_s > 0.0) || !std::isfinite(interval_s)) {
    throw std::invalid_argument("interval length " + std::to_string(interval_s) + " s is not positive and finite");
  }
}

void require_intervals(long intervals) {
  if (intervals < 1 || intervals > kMaxIntervals) {
    throw std::invalid_argument("a spline has 1 to " + std::to_string(kMaxIntervals) + " intervals, not " +
                                std::to_string(intervals));
  }
}

}  // namespace

struct SplineBasis::Tables {
  struct Interval {
    Eigen::Matrix4d power;
    Eigen::Matrix4d position_minvo;
    Eigen::Matrix<double, 4, 3> velocity_minvo;
    Eigen::Matrix<double, 4, 3> velocity_bezier;
    Eigen::Matrix<double, 4, 2> acceleration_ends;
    Eigen::Vector4d jerk;
  };
  std::vector<Interval> intervals;

  const Interval& at(int j) const {
    if (j < 0 || j >= static_cast<int>(intervals.size())) throw_interval(j, static_cast<int>(intervals.size()));
    return intervals[idx(j)];
  }

  static Interval make(int count, int j) {
    Interval t;
    t.power = cox_de_boor(count, j);
    t.position_minvo = t.power * minvo_inverse_3();
    Eigen::Matrix<double, 4, 3> velocity;  // dP/du in powers u² u 1
    velocity << 3.0 * t.power.col(0), 2.0 * t.power.col(1), t.power.col(2);
    t.velocity_minvo = velocity * minvo_inverse_2();
    t.velocity_bezier << velocity.col(2), velocity.col(2) + velocity.col(1) / 2.0, velocity.rowwise().sum();
    t.acceleration_ends << velocity.col(1), 2.0 * velocity.col(0) + velocity.col(1);
    t.jerk = 2.0 * velocity.col(0);
    return t;
  }
};

SplineBasis::SplineBasis(int intervals) : intervals_(intervals) {
  require_intervals(intervals);
  auto tables = std::make_shared<Tables>();
  tables->intervals.reserve(static_cast<std::size_t>(intervals));
  for (int j = 0; j < intervals; ++j) tables->intervals.push_back(Tables::make(intervals, j));
  tables_ = std::move(tables);
}

const Eigen::Matrix4d& SplineBasis::power(int j) const { return tables_->at(j).power; }
const Eigen::Matrix4d& SplineBasis::position_minvo(int j) const { return tables_->at(j).position_minvo; }
const Eigen::Matrix<double, 4, 3>& SplineBasis::velocity_minvo(int j) const { return tables_->at(j).velocity_minvo; }
const Eigen::Matrix<double, 4, 3>& SplineBasis::velocity_bezier(int j) const { return tables_->at(j).velocity_bezier; }
const Eigen::Matrix<double, 4, 2>& SplineBasis::acceleration_ends(int j) const {
  return tables_->at(j).acceleration_ends;
}
const Eigen::Vector4d& SplineBasis::jerk(int j) const { return tables_->at(j).jerk; }

const SplineBasis& spline_basis(int intervals) {
  require_intervals(intervals);
  // The bases are never freed, because splines in static variables may outlive every other static variable.
  static std::array<std::atomic<const SplineBasis*>, kMaxIntervals + 1> made{};
  std::atomic<const SplineBasis*>& slot = made[idx(intervals)];
  if (const SplineBasis* basis = slot.load(std::memory_order_acquire)) return *basis;
  auto fresh = std::make_unique<const SplineBasis>(intervals);
  const SplineBasis* other = nullptr;
  if (slot.compare_exchange_strong(other, fresh.get(), std::memory_order_acq_rel)) return *fresh.release();
  return *other;
}

ClampedSpline::ClampedSpline(Points control_points, double interval_s)
    : control_points_(std::move(control_points)), interval_s_(interval_s), basis_(nullptr) {
  const long intervals = static_cast<long>(control_points_.cols()) - 3;
  require_intervals(intervals);
  require_interval_length(interval_s);
  if (!control_points_.allFinite()) throw std::invalid_argument("a control point is not finite");
  basis_ = &spline_basis(static_cast<int>(intervals));
}

MotionSample ClampedSpline::sample(double t_s) const {
  if (!(t_s >= 0.0)) throw std::invalid_argument("sample at " + std::to_string(t_s) + " s, before the spline's start");
  MotionSample s;
  if (t_s > duration_s()) {
    s.p = control_points_.rightCols<1>();
    return s;
  }
  const int last = intervals() - 1;
  int j = std::min(static_cast<int>(t_s / interval_s_), last);
  // For t = k·Δt, t/Δt may round to a number just below the knot k.
  if (j < last && (j + 1) * interval_s_ <= t_s) ++j;
  const double u = std::clamp((t_s - j * interval_s_) / interval_s_, 0.0, 1.0);
  s = sample_cubic(power(j), u);
  s.v /= interval_s_;
  s.a /= interval_s_ * interval_s_;
  s.j /= interval_s_ * interval_s_ * interval_s_;
  return s;
}

PowerCubic ClampedSpline::power(int j) const {
  const Eigen::Matrix4d& basis = basis_->power(j);
  const Points3 from_first = control_points_.middleCols<3>(j + 1).colwise() - control_points_.col(j);
  PowerCubic c = from_first * basis.bottomRows<3>();
  c.col(3) += control_points_.col(j);
  return c;
}

Points4 ClampedSpline::minvo(int j) const {
  const Eigen::Matrix4d& basis = basis_->position_minvo(j);
  const Points3 from_first = control_points_.middleCols<3>(j + 1).colwise() - control_points_.col(j);
  const Points4 relative = from_first * basis.bottomRows<3>();
  return relative.colwise() + control_points_.col(j);
}

Points4 ClampedSpline::minvo(int j, double u0, double u1) const {
  if (!(0.0 <= u0 && u0 < u1 && u1 <= 1.0)) {
    throw std::invalid_argument("part [" + std::to_string(u0) + ", " + std::to_string(u1) + "] is not within [0, 1]");
  }
  return minvo_points(reparametrized(power(j), u0, u1));
}

Box ClampedSpline::position_bounds(int j) const { return cubic_bounds(power(j), 0.0, 1.0); }

bool ClampedSpline::ends_at_rest() const {
  const Eigen::Index n = control_points_.cols() - 1;
  return control_points_.col(n) == control_points_.col(n - 1) && control_points_.col(n) == control_points_.col(n - 2);
}

Points3 start_control_points(const MotionSample& start, double interval_s) {
  require_interval_length(interval_s);
  Points3 q;
  q.col(0) = start.p;
  q.col(1) = q.col(0) + start.v * (interval_s / 3.0);
  q.col(2) = q.col(1) + (start.v + start.a * (interval_s / 2.0)) * (2.0 * interval_s / 3.0);
  return q;
}

ClampedSpline at_rest(const Vec3& p, int intervals, double interval_s) {
  require_intervals(intervals);
  return {p.replicate(1, intervals + 3), interval_s};
}

MotionBounds motion_bounds(const ClampedSpline& spline, int j) {
  const PowerCubic c = spline.power(j);
  const double dt = spline.interval_s();
  MotionBounds b;
  b.v_max = max_abs_velocity(c, 0.0, 1.0) / dt;
  b.a_max = max_abs_acceleration(c, 0.0, 1.0) / (dt * dt);
  b.j_max = 6.0 * c.col(0).cwiseAbs() / (dt * dt * dt);
  return b;
}

MotionBounds motion_bounds(const ClampedSpline& spline) {
  MotionBounds b;
  for (int j = 0; j < spline.intervals(); ++j) {
    const MotionBounds part = motion_bounds(spline, j);
    b.v_max = b.v_max.cwiseMax(part.v_max);
    b.a_max = b.a_max.cwiseMax(part.a_max);
    b.j_max = b.j_max.cwiseMax(part.j_max);
  }
  return b;
}

}  // namespace tern
