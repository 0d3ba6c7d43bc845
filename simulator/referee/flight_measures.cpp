#include "simulator/referee/flight_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/referee/first_time.h"

namespace tern {
namespace {

constexpr const char* kAxis[] = {"x", "y", "z"};

/// ∫‖v‖ dt by three-point Gauss–Legendre: exact to O(h⁷).
double path_length(const FlownPiece& piece, double t0, double t1) {
  const double middle = 0.5 * (t0 + t1);
  const double half = 0.5 * (t1 - t0);
  const double node = half * std::sqrt(0.6);
  const auto speed = [&](double t) { return piece.velocity(t).norm(); };
  return half * (5.0 * speed(middle - node) + 8.0 * speed(middle) + 5.0 * speed(middle + node)) / 9.0;
}

/// Fraction of [t0, t1] in which `inside` holds, if it changes at most once in between.
template <class F>
double fraction_inside(const F& inside, double t0, double t1) {
  const bool first = inside(t0);
  const bool last = inside(t1);
  if (first == last) return first ? 1.0 : 0.0;
  double low = t0;
  double high = t1;
  while (high - low > kMeasureTimeResolution) {
    const double middle = 0.5 * (low + high);
    (inside(middle) == first ? low : high) = middle;
  }
  const double change = (high - t0) / (t1 - t0);
  return first ? change : 1.0 - change;
}

/// Rounding of a joint that was accepted exactly at the tolerance.
constexpr double kJoinRounding = 1e-9;

bool differs(const Vec3& a, const Vec3& b) {
  return !((a - b).cwiseAbs().maxCoeff() <= kJoinTolerance + kJoinRounding);
}

}  // namespace

std::optional<double> first_entry(const FlownPiece& piece, double t0_s, double t1_s, const Vec3& goal) {
  const auto beyond = [&](double t) { return (piece.at(t).p - goal).norm() - kGoalRadius; };
  return first_time_below_zero(beyond, piece.speed_bound(t0_s, t1_s), t0_s, t1_s, kMeasureTimeResolution);
}

std::optional<double> first_arrival(const FlownPiece& piece, double t0_s, double t1_s, const Vec3& goal) {
  const auto missing = [&](double t) {
    return std::max((piece.at(t).p - goal).norm() - kGoalRadius, piece.velocity(t).norm() - kRestSpeed);
  };
  const double lipschitz = std::max(piece.speed_bound(t0_s, t1_s), piece.acceleration_bound(t0_s, t1_s));
  return first_time_below_zero(missing, lipschitz, t0_s, t1_s, kMeasureTimeResolution);
}

LimitWatch::LimitWatch(const UavSpec& uav, const Box& body_bounds)
    : limits_(uav.limits),
      centre_box_(uav.flight_box.min() - body_bounds.min() - Vec3::Constant(kBoxTolerance),
                  uav.flight_box.max() - body_bounds.max() + Vec3::Constant(kBoxTolerance)) {}

void LimitWatch::advance(const FlownPiece& piece, double t0_s, double t1_s) {
  const double from = t0_s - piece.start_s;
  const double to = t1_s - piece.start_s;
  judge(Speed, max_abs_velocity(piece.coefficients, from, to), limits_.v_max, t0_s);
  judge(Acceleration, max_abs_acceleration(piece.coefficients, from, to), limits_.a_max, t0_s);
  judge(Jerk, 6.0 * piece.coefficients.col(0).cwiseAbs(), limits_.j_max, t0_s);
  const Box flown = cubic_bounds(piece.coefficients, from, to);
  const bool outside = !centre_box_.contains(flown);
  count(FlightBox, outside,
        outside ? fmt::format("body outside the flight box at {:.3f} s, position ({:.3f}, {:.3f}, {:.3f}) m", t0_s,
                              flown.center().x(), flown.center().y(), flown.center().z())
                : std::string());
}

void LimitWatch::judge(Kind kind, const Vec3& value, const Vec3& limit, double t_s) {
  static constexpr const char* kName[] = {"speed", "acceleration", "jerk"};
  static constexpr const char* kUnit[] = {"m/s", "m/s^2", "m/s^3"};
  for (int i = 0; i < 3; ++i) {
    if (value[i] <= limit[i] * (1.0 + kLimitTolerance)) continue;
    return count(kind, true,
                 fmt::format("{} along {} {} {}, limit {}, at {:.3f} s", kName[kind], kAxis[i], value[i], kUnit[kind],
                             limit[i], t_s));
  }
  count(kind, false, {});
}

void LimitWatch::count(Kind kind, bool broken, const std::string& what) {
  if (broken && !broken_[kind]) {
    ++violations_;
    if (first_.empty()) first_ = what;
  }
  broken_[kind] = broken;
}

void LimitWatch::join(const MotionSample& before, const MotionSample& now, double t_s) {
  const bool jerk_limited = limits_.j_max.allFinite();
  const char* what = differs(before.p, now.p)                   ? "position"
                     : differs(before.v, now.v)                 ? "velocity"
                     : jerk_limited && differs(before.a, now.a) ? "acceleration"
                                                                : nullptr;
  if (what == nullptr) return;
  ++violations_;
  if (first_.empty()) first_ = fmt::format("{} jumps at {:.6f} s", what, t_s);
}

FlightMeasures::FlightMeasures(const std::vector<Region>& regions) : regions_(regions) {
  for (const Region& region : regions_) exposure_.push_back({region.name});
}

void FlightMeasures::advance(const FlownPiece& piece, double t0_s, double t1_s, bool arrives) {
  const double length = path_length(piece, t0_s, t1_s);
  path_length_m_ += length;
  jerk_integral_ += 36.0 * piece.coefficients.col(0).squaredNorm() * (t1_s - t0_s);
  for (const double t : {t0_s, 0.5 * (t0_s + t1_s), t1_s})
    top_speed_mps_ = std::max(top_speed_mps_, piece.velocity(t).norm());
  count_stops(piece, std::max(t0_s, kStopsCountFrom), arrives ? t1_s - 2.0 * kMeasureTimeResolution : t1_s);
  add_exposure(piece, t0_s, t1_s, length);
}

void FlightMeasures::count_stops(const FlownPiece& piece, double t0_s, double t1_s) {
  const double steepness = piece.acceleration_bound(t0_s, t1_s);
  const auto above = [&](double t) { return piece.velocity(t).norm() - kRestSpeed; };
  const auto below = [&](double t) { return -above(t); };
  for (double t = t0_s; t <= t1_s;) {
    const auto change = stopped_ ? first_time_below_zero(below, steepness, t, t1_s, kMeasureTimeResolution)
                                 : first_time_below_zero(above, steepness, t, t1_s, kMeasureTimeResolution);
    if (!change) return;
    stopped_ = !stopped_;
    if (stopped_) ++stops_;
    t = *change + kMeasureTimeResolution;
  }
}

void FlightMeasures::add_exposure(const FlownPiece& piece, double t0_s, double t1_s, double length_m) {
  const double reach = kNearRegion + length_m;
  const Vec3 p0 = piece.at(t0_s).p;
  for (std::size_t k = 0; k < regions_.size(); ++k) {
    if (regions_[k].bounds().exteriorDistance(p0) > reach) continue;
    const auto distance = [&](double t) { return regions_[k].distance(piece.at(t).p); };
    const double in = fraction_inside([&](double t) { return distance(t) <= 0.0; }, t0_s, t1_s);
    const double near = fraction_inside([&](double t) { return distance(t) <= kNearRegion; }, t0_s, t1_s);
    exposure_[k].seconds += in * (t1_s - t0_s);
    exposure_[k].metres += in * length_m;
    exposure_[k].near_seconds += near * (t1_s - t0_s);
    exposure_[k].near_metres += near * length_m;
  }
}

}  // namespace tern
