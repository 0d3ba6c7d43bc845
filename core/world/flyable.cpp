#include "core/world/flyable.h"

#include <fmt/format.h>

#include <cmath>

#include "core/wire/message_limits.h"
#include "core/world/body.h"
#include "core/world/thrust.h"

namespace tern {
namespace {

constexpr int kMinIntervals = 4;

BreachReport shape_breach(const TimedSpline& trajectory) {
  const auto intervals = static_cast<double>(trajectory.control_points.cols() - 3);
  if (intervals < kMinIntervals || intervals > kMaxIntervals) {
    return {Breach::Shape, "{0:.0f} intervals, not 4 to {1:.0f}", intervals, kMaxIntervals};
  }
  if (trajectory.interval <= Duration{0} || trajectory.interval > kMaxIntervalDuration) {
    return {Breach::Shape, "interval of {0:.0f} us", static_cast<double>(trajectory.interval.us)};
  }
  if (!trajectory.control_points.allFinite()) return {Breach::Shape, "a control point is not finite"};
  return {};
}

/// Returns the first axis on which value > limit or value is NaN.
BreachReport beyond(Breach breach, const char* format, const Vec3& value, const Vec3& limit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(value[axis] <= limit[axis])) return {breach, format, value[axis], limit[axis], axis};
  }
  return {};
}

BreachReport join_breach(const MotionSample& begin, const MotionSample& start) {
  const Vec3 tolerance = Vec3::Constant(kJoinTolerance);
  const auto gap = [&](const char* format, const Vec3& a, const Vec3& b) {
    return beyond(Breach::Join, format, (a - b).cwiseAbs(), tolerance);
  };
  if (auto r = gap("position differs from the start on {2} by {0:.9g}, more than {1:.9g}", begin.p, start.p); !r.ok())
    return r;
  if (auto r = gap("velocity differs from the start on {2} by {0:.9g}, more than {1:.9g}", begin.v, start.v); !r.ok())
    return r;
  return gap("acceleration differs from the start on {2} by {0:.9g}, more than {1:.9g}", begin.a, start.a);
}

BreachReport limit_breach(const ClampedSpline& spline, const Limits& limits) {
  constexpr double kScale = 1.0 + kLimitTolerance;
  const MotionBounds most = motion_bounds(spline);
  const auto over = [&](Breach breach, const char* format, const Vec3& value, const Vec3& limit) {
    return beyond(breach, format, value, limit * kScale);
  };
  if (auto r = over(Breach::Velocity, "|v| {2} = {0:.9g} beyond {1:.9g}", most.v_max, limits.v_max); !r.ok()) return r;
  if (auto r = over(Breach::Acceleration, "|a| {2} = {0:.9g} beyond {1:.9g}", most.a_max, limits.a_max); !r.ok())
    return r;
  return over(Breach::Jerk, "|j| {2} = {0:.9g} beyond {1:.9g}", most.j_max, limits.j_max);
}

BreachReport box_breach(const ClampedSpline& spline, const Box& centre_box) {
  Box swept;
  for (int j = 0; j < spline.intervals(); ++j) swept.extend(spline.position_bounds(j));
  const Vec3 tolerance = Vec3::Constant(kBoxTolerance);
  const auto out = [&](const char* format, const Vec3& distance) {
    return beyond(Breach::FlightBox, format, distance, tolerance);
  };
  if (auto r = out("above the flight box on {2} by {0:.9g}, more than {1:.9g}", swept.max() - centre_box.max());
      !r.ok())
    return r;
  return out("below the flight box on {2} by {0:.9g}, more than {1:.9g}", centre_box.min() - swept.min());
}

}  // namespace

std::string BreachReport::text() const {
  return fmt::format(fmt::runtime(format), value, limit, axis < 0 ? '?' : "xyz"[axis]);
}

Box centre_box(const Box& flight_box, const Body& body) { return places_within(flight_box, body_box(body)); }

BreachReport breach_of(const ClampedSpline& spline, const Dynamics& dynamics) {
  constexpr double kMore = 1.0 + kLimitTolerance;
  constexpr double kLess = 1.0 - kLimitTolerance;
  const double slope = tilt_slope(dynamics.tilt_max_deg);
  for (int j = 0; j < spline.intervals(); ++j) {
    const ThrustBounds b = thrust_bounds(spline, j);
    if (!(b.min_thrust >= dynamics.thrust_min * kLess))
      return {Breach::Thrust, "thrust {0:.9g} below {1:.9g}", b.min_thrust, dynamics.thrust_min, -1, j};
    if (!(b.max_thrust <= dynamics.thrust_max * kMore))
      return {Breach::Thrust, "thrust {0:.9g} beyond {1:.9g}", b.max_thrust, dynamics.thrust_max, -1, j};
    if (!(b.slope <= slope * kMore))
      return {Breach::Tilt,
              "tilt {0:.9g} deg beyond {1:.9g}",
              to_degrees(std::atan(b.slope)),
              dynamics.tilt_max_deg,
              -1,
              j};
    const double rate = to_degrees(b.body_rate);
    if (!(rate <= dynamics.body_rate_max_deg_s * kMore))
      return {Breach::BodyRate, "body rate {0:.9g} deg/s beyond {1:.9g}", rate, dynamics.body_rate_max_deg_s, -1, j};
  }
  return {};
}

BreachReport breach_of(const TimedSpline& trajectory, UTime t_s, const MotionSample& start, const Limits& limits,
                       const Box& centre_box) {
  if (auto r = shape_breach(trajectory); !r.ok()) return r;
  if (trajectory.start != t_s) {
    return {Breach::Start, "starts {0:.0f} us after t_s", static_cast<double>((trajectory.start - t_s).us)};
  }
  const ClampedSpline spline = trajectory.spline();
  if (auto r = join_breach(spline.sample(0.0), start); !r.ok()) return r;
  if (!spline.ends_at_rest()) return {Breach::End, "the last three control points differ"};
  if (auto r = limit_breach(spline, limits); !r.ok()) return r;
  if (limits.dynamics) {
    if (auto r = breach_of(spline, *limits.dynamics); !r.ok()) return r;
  }
  return box_breach(spline, centre_box);
}

}  // namespace tern
