#include "planner/search/axis_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/types.h"

namespace tern {
namespace {

using Point = Eigen::Vector2d;
using Polygon = std::vector<Point>;

/// Tolerance by which a velocity at the end of its range stays in it despite rounding, m/s.
constexpr double kOnBoundary = 1e-9;

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

/// Computes the counter-clockwise convex hull of `points` by Andrew's monotone chain; sorts `points`.
void convex(Polygon& points, Polygon& hull) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) {
    hull = points;
    return;
  }
  hull.resize(2 * points.size());
  std::size_t k = 0;
  for (const Point& p : points) {
    while (k >= 2 && cross(hull[k - 2], hull[k - 1], p) <= 0.0) --k;
    hull[k++] = p;
  }
  const std::size_t lower = k + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    while (k >= lower && cross(hull[k - 2], hull[k - 1], points[i]) <= 0.0) --k;
    hull[k++] = points[i];
  }
  hull.resize(k - 1);
}

/// Computes the part of a convex polygon with sign·coordinate ≤ limit (Sutherland–Hodgman).
void clip(const Polygon& polygon, int coordinate, double sign, double limit, Polygon& kept) {
  kept.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const double da = sign * a[coordinate] - limit;
    const double db = sign * b[coordinate] - limit;
    if (da <= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
}

/// Clips `polygon` to the limits; `other` is scratch memory.
void clip_box(Polygon& polygon, Polygon& other, double v_max, double a_max) {
  for (const double sign : {1.0, -1.0}) {
    clip(polygon, 0, sign, v_max, other);
    clip(other, 1, sign, a_max, polygon);
  }
}

double largest_velocity(const Polygon& polygon) {
  double largest = 0.0;
  for (const Point& p : polygon) largest = std::max(largest, p.x());
  return largest;
}

/// Returns the range of a for which (v + a Δt, a) is in the polygon.
AxisReach::Interval line_in_polygon(const Polygon& polygon, double v, double dt) {
  // In sheared coordinates (v' − a Δt, a) the line is vertical: the polygon's a-range at first coordinate v.
  constexpr double kInf = std::numeric_limits<double>::infinity();
  AxisReach::Interval range{kInf, -kInf};
  const auto take = [&](double a) {
    range.low = std::min(range.low, a);
    range.high = std::max(range.high, a);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double sp = p.x() - p.y() * dt - v;
    const double sq = q.x() - q.y() * dt - v;
    if (std::abs(sp) <= kOnBoundary) take(p.y());
    if ((sp < 0.0 && sq > 0.0) || (sp > 0.0 && sq < 0.0)) take(p.y() + (q.y() - p.y()) * (sp / (sp - sq)));
  }
  return range;
}

}  // namespace

void AxisReach::set_limits(int intervals, double interval_s, double v_max, double a_max, double j_max) {
  intervals_ = intervals;
  dt_ = interval_s;
  v_max_ = v_max;
  a_max_ = a_max;
  j_step_ = std::min(j_max * interval_s, 2.0 * a_max);
  fastest_.resize(static_cast<std::size_t>(intervals_));
  const auto last_index = idx(intervals_);
  if (finishable_.size() <= last_index) finishable_.resize(last_index + 1);
}

void AxisReach::close_end(double j_step) {
  const double last = std::min(a_max_, j_step);
  finishable_[idx(intervals_)].assign({Point(0.0, -last), Point(0.0, last)});
}

void AxisReach::step_back(const Polygon& next, double j_step, std::size_t l) {
  auto& [points, other] = scratch_;
  points.clear();
  for (const Point& p : next) {
    for (const double sign : {1.0, -1.0}) points.emplace_back(p.x() - p.y() * dt_, p.y() + sign * j_step);
  }
  convex(points, other);
  clip_box(other, points, v_max_, a_max_);
  convex(other, finishable_[l]);
}

void AxisReach::assign(int intervals, double interval_s, double v_max, double a_max, double j_max) {
  set_limits(intervals, interval_s, v_max, a_max, j_max);
  for (int k = 0; k < intervals_; ++k) {
    fastest_[idx(k)] = std::min(v_max_, a_max_ * dt_ * (intervals_ - k));
  }
  close_end(j_step_);
  for (auto l = idx(intervals_) - 1; l >= 2; --l) step_back(finishable_[l + 1], j_step_, l);
}

void AxisReach::assign_before(const AxisReach& rest, double a_max, double j_max) {
  set_limits(rest.intervals_, rest.dt_, rest.v_max_, a_max, j_max);
  close_end(rest.j_step_);
  for (auto l = idx(intervals_) - 1; l >= 2; --l) {
    step_back(rest.finishable_[l + 1], rest.j_step_, l);
    fastest_[l] = largest_velocity(finishable_[l]);
  }
}

AxisReach::Interval AxisReach::next_velocity(int l, double v, double a_previous) const {
  Interval a = line_in_polygon(finishable_[idx(l) + 1], v, dt_);
  a.low = std::max({a.low, -a_max_, a_previous - j_step_});
  a.high = std::min({a.high, a_max_, a_previous + j_step_});
  // On the border of the set only one acceleration is left, and rounding may exchange its bounds.
  if (a.low > a.high && (a.low - a.high) * dt_ <= kOnBoundary) a.low = a.high = 0.5 * (a.low + a.high);
  return {v + a.low * dt_, v + a.high * dt_};
}

double AxisReach::farthest(int l, double v_previous) const {
  const double step = a_max_ * dt_;
  double sum = 0.0;
  double v = v_previous;
  for (int k = l; k < intervals_; ++k) {
    v = std::min(v + step, fastest_[idx(k)]);
    sum += v;
  }
  return sum * dt_;
}

AxisReach::Interval AxisReach::displacement(int l, double v_previous) const {
  return {-farthest(l, -v_previous), farthest(l, v_previous)};
}

}  // namespace tern
