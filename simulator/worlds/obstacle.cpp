#include "simulator/worlds/obstacle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLimit = WorldObstacle::kMaxCoordinate;

double period(const WaypointMotion& m) { return m.points.back().first - m.points.front().first; }

/// Reduces t to [first time, first time + period).
double wrapped(const WaypointMotion& m, double t) {
  const double first = m.points.front().first;
  const double rest = std::fmod(t - first, period(m));
  return first + (rest < 0.0 ? rest + period(m) : rest);
}

ObstacleState state(const Vec3& c, const StaticMotion&, double) { return {c, Vec3::Zero()}; }

ObstacleState state(const Vec3& c, const TrefoilMotion& m, double t) {
  const double w = t / m.slowness;
  const Vec3 shape(std::sin(w + m.phase) + 2.0 * std::sin(2.0 * w + m.phase),
                   std::cos(w + m.phase) - 2.0 * std::cos(2.0 * w + m.phase), -std::sin(3.0 * w + m.phase));
  const Vec3 slope(std::cos(w + m.phase) + 4.0 * std::cos(2.0 * w + m.phase),
                   -std::sin(w + m.phase) + 4.0 * std::sin(2.0 * w + m.phase), -3.0 * std::cos(3.0 * w + m.phase));
  return {c + m.scale.cwiseProduct(shape), m.scale.cwiseProduct(slope) / m.slowness};
}

ObstacleState state(const Vec3& c, const WaveMotion& m, double t) {
  const double w = t / m.slowness + m.phase;
  return {c + m.amplitude * std::sin(w), m.amplitude * (std::cos(w) / m.slowness)};
}

ObstacleState state(const Vec3& c, const LinearMotion& m, double t) {
  if (t < m.from_s) return {c, Vec3::Zero()};
  return {c + m.velocity * (t - m.from_s), m.velocity};
}

ObstacleState state(const Vec3&, const WaypointMotion& m, double t) {
  const double at = m.repeat ? wrapped(m, t) : t;
  const auto next = std::ranges::upper_bound(m.points, at, {}, [](const auto& point) { return point.first; });
  if (next == m.points.begin()) return {next->second, Vec3::Zero()};
  const auto& [t0, p0] = *(next - 1);
  if (next == m.points.end()) return {p0, Vec3::Zero()};
  const Vec3 v = (next->second - p0) / (next->first - t0);
  return {p0 + v * (at - t0), v};
}

ObstacleBounds bounds_of(const StaticMotion&) { return {}; }

ObstacleBounds bounds_of(const TrefoilMotion& m) {
  const Vec3 k = m.scale.cwiseAbs();
  const double s2 = m.slowness * m.slowness;
  return {Vec3(5, 5, 3).cwiseProduct(k) / m.slowness, 9.0 * k / s2, Vec3(33, 33, 81).cwiseProduct(k) / (s2 * s2)};
}

ObstacleBounds bounds_of(const WaveMotion& m) {
  const Vec3 a = m.amplitude.cwiseAbs();
  const double s2 = m.slowness * m.slowness;
  return {a / m.slowness, a / s2, a / (s2 * s2)};
}

ObstacleBounds bounds_of(const LinearMotion& m) { return {m.velocity.cwiseAbs(), Vec3::Zero(), Vec3::Zero()}; }

ObstacleBounds bounds_of(const WaypointMotion& m) {
  ObstacleBounds b;
  for (std::size_t i = 1; i < m.points.size(); ++i) {
    const Vec3 v = (m.points[i].second - m.points[i - 1].second) / (m.points[i].first - m.points[i - 1].first);
    b.speed = b.speed.cwiseMax(v.cwiseAbs());
  }
  return b;
}

/// The first corner after t ≥ 0.
double corner_after(const WaypointMotion& m, double t) {
  const double at = m.repeat ? wrapped(m, t) : t;
  const auto next = std::ranges::upper_bound(m.points, at, {}, [](const auto& point) { return point.first; });
  if (next == m.points.end()) return kInfinity;
  return std::max(t + (next->first - at), std::nextafter(t, kInfinity));
}
double corner_after(const LinearMotion& m, double t) { return m.from_s > t ? m.from_s : kInfinity; }
template <class Smooth>
double corner_after(const Smooth&, double) {
  return kInfinity;
}

bool within(const Vec3& v, double limit) { return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit; }

std::string text(const Vec3& v) { return fmt::format("({}, {}, {})", v.x(), v.y(), v.z()); }

/// Rounds a motion's times. @return its fault, or ""
std::string settle(StaticMotion&) { return {}; }

std::string settle_oscillation(double slowness, double phase) {
  if (!(slowness >= 1e-3 && slowness <= kLimit))
    return fmt::format("slowness {}, not in [0.001, {}]", slowness, kLimit);
  if (!(std::abs(phase) <= kLimit)) return fmt::format("phase {}, not in ±{}", phase, kLimit);
  return {};
}

std::string settle(TrefoilMotion& m) {
  if (!within(m.scale, kLimit)) return fmt::format("scale {}, not in ±{} m", text(m.scale), kLimit);
  return settle_oscillation(m.slowness, m.phase);
}

std::string settle(WaveMotion& m) {
  if (!within(m.amplitude, kLimit)) return fmt::format("amplitude {}, not in ±{} m", text(m.amplitude), kLimit);
  return settle_oscillation(m.slowness, m.phase);
}

std::string settle(LinearMotion& m) {
  if (!within(m.velocity, kLimit)) return fmt::format("velocity {}, not in ±{} m/s", text(m.velocity), kLimit);
  if (!(std::abs(m.from_s) <= kLimit)) return fmt::format("from_s {}, not in ±{} s", m.from_s, kLimit);
  m.from_s = whole_microseconds(m.from_s);
  return {};
}

std::string settle(WaypointMotion& m) {
  if (m.points.empty()) return "no waypoints, 1 is the least";
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    auto& [t, p] = m.points[i];
    if (!(std::abs(t) <= kLimit)) return fmt::format("waypoint {}: time {} s, not in ±{}", i, t, kLimit);
    if (!within(p, kLimit)) return fmt::format("waypoint {}: position {}, not in ±{} m", i, text(p), kLimit);
    t = whole_microseconds(t);
    if (i > 0 && !(t > m.points[i - 1].first)) {
      return fmt::format("waypoint {}: time {} s does not come 1 us or more after {} s", i, t, m.points[i - 1].first);
    }
  }
  if (m.repeat && m.vanish) return "repeat and vanish exclude each other";
  if (m.repeat && (m.points.size() < 2 || m.points.front().second != m.points.back().second)) {
    return "a repeating motion has 2 waypoints or more and ends where it began";
  }
  if (m.vanish && (m.points.size() < 2 || m.points.back().first <= 0.0)) {
    return fmt::format("a vanishing motion lasts some time and until after 0 s, not {} s", m.points.back().first);
  }
  return {};
}

}  // namespace

double whole_microseconds(double t_s) { return std::round(t_s * 1e6) / 1e6; }

double distance_to_box(const Vec3& p, const Vec3& c, const Vec3& h) {
  return ((p - c).cwiseAbs() - h).cwiseMax(0.0).norm();
}

ObstacleState motion_state(const ObstacleSpec& spec, double t_s) {
  return std::visit([&](const auto& m) { return state(spec.centre, m, t_s); }, spec.motion);
}

Result<WorldObstacle> WorldObstacle::make(std::int64_t id, ObstacleSpec spec) {
  const auto refuse = [&](const std::string& why) {
    const std::string name = spec.name.empty() ? std::string() : fmt::format(" '{}'", spec.name);
    return fail(fmt::format("obstacle {}{}: {}", id, name, why));
  };
  if (!within(spec.centre, kLimit)) return refuse(fmt::format("centre {}, not in ±{} m", text(spec.centre), kLimit));
  if (!within(spec.half_extents, kLimit) || spec.half_extents.minCoeff() <= 0.0) {
    return refuse(fmt::format("half-extents {}, not in (0, {}] m", text(spec.half_extents), kLimit));
  }
  const std::string wrong = std::visit([](auto& m) { return settle(m); }, spec.motion);
  if (!wrong.empty()) return refuse(wrong);

  WorldObstacle o;
  o.id_ = id;
  o.bounds_ = std::visit([](const auto& m) { return bounds_of(m); }, spec.motion);
  o.moves_ = o.bounds_.speed.maxCoeff() > 0.0;
  o.first_s_ = -kInfinity;
  o.last_s_ = kInfinity;
  if (const auto* m = std::get_if<WaypointMotion>(&spec.motion)) {
    spec.centre = m->points.front().second;
    if (m->vanish && m->points.front().first > 0.0) o.first_s_ = m->points.front().first;
    if (m->vanish) o.last_s_ = m->points.back().first;
  }
  o.spec_ = std::move(spec);
  return o;
}

ObstacleState WorldObstacle::at(double t_s) const {
  if (t_s >= 0.0) return motion_state(spec_, t_s);
  return {motion_state(spec_, 0.0).p, Vec3::Zero()};
}

double WorldObstacle::begins_s() const {
  if (const auto* linear = std::get_if<LinearMotion>(&spec_.motion)) return linear->from_s;
  const auto* way = std::get_if<WaypointMotion>(&spec_.motion);
  return way == nullptr || way->repeat ? -kInfinity : way->points.front().first;
}

double WorldObstacle::next_corner(double t_s) const {
  if (!moves_) return kInfinity;
  if (t_s < 0.0) return 0.0;
  return std::visit([&](const auto& m) { return corner_after(m, t_s); }, spec_.motion);
}

}  // namespace tern
