#include "executor/adoption.h"

#include <fmt/format.h>

#include "core/world/body.h"
#include "core/world/message_limits.h"

namespace tern {
namespace {

constexpr char kAxes[] = {'x', 'y', 'z'};
constexpr int kLeastIntervals = 4;

Adoption check_form(const TimedSpline& trajectory, UTime t_s) {
  const auto intervals = trajectory.control_points.cols() - 3;
  if (intervals < kLeastIntervals || intervals > kMaxIntervals) {
    return {Verdict::Shape, fmt::format("{} intervals, not {} to {}", intervals, kLeastIntervals, kMaxIntervals)};
  }
  if (trajectory.interval <= Duration{0} || trajectory.interval > kLongestInterval) {
    return {Verdict::Shape, fmt::format("interval of {} us", trajectory.interval.us)};
  }
  if (!trajectory.control_points.allFinite()) return {Verdict::Shape, "a control point is not finite"};
  if (trajectory.start != t_s) {
    return {Verdict::Start, fmt::format("starts {} us after t_s", (trajectory.start - t_s).us)};
  }
  return {Verdict::Adopted, {}};
}

/// The first axis on which |value| > limit (both per axis) as a refusal, else Adopted.
Adoption within(Verdict refusal, const char* what, const Vec3& value, const Vec3& limit) {
  for (int i = 0; i < 3; ++i) {
    if (!(value[i] <= limit[i])) {
      return {refusal, fmt::format("{} {} = {:.9g} beyond {:.9g}", what, kAxes[i], value[i], limit[i])};
    }
  }
  return {Verdict::Adopted, {}};
}

Adoption check_join(const MotionSample& begin, const MotionSample& start) {
  const Vec3 tolerance = Vec3::Constant(kJoinTolerance);
  Adoption result = within(Verdict::Join, "position gap", (begin.p - start.p).cwiseAbs(), tolerance);
  if (is_refusal(result.verdict)) return result;
  result = within(Verdict::Join, "velocity gap", (begin.v - start.v).cwiseAbs(), tolerance);
  if (is_refusal(result.verdict)) return result;
  return within(Verdict::Join, "acceleration gap", (begin.a - start.a).cwiseAbs(), tolerance);
}

Adoption check_limits(const MotionBounds& bounds, const Limits& limits) {
  constexpr double kScale = 1.0 + kLimitTolerance;
  Adoption result = within(Verdict::Velocity, "|v|", bounds.v_max, limits.v_max * kScale);
  if (is_refusal(result.verdict)) return result;
  result = within(Verdict::Acceleration, "|a|", bounds.a_max, limits.a_max * kScale);
  if (is_refusal(result.verdict)) return result;
  return within(Verdict::Jerk, "|j|", bounds.j_max, limits.j_max * kScale);
}

Adoption check_flight_box(const ClampedSpline& spline, const Body& body, const Box& flight_box) {
  Box swept;
  for (int j = 0; j < spline.intervals(); ++j) swept.extend(spline.position_bounds(j));
  const Vec3 low = body.vertices.rowwise().minCoeff().array() - body.radius;
  const Vec3 high = body.vertices.rowwise().maxCoeff().array() + body.radius;
  const Vec3 tolerance = Vec3::Constant(kBoxTolerance);
  const Adoption result =
      within(Verdict::FlightBox, "above the box by", swept.max() + high - flight_box.max(), tolerance);
  if (is_refusal(result.verdict)) return result;
  return within(Verdict::FlightBox, "below the box by", flight_box.min() - swept.min() - low, tolerance);
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::Adopted: return "adopted";
    case Verdict::Kept: return "kept";
    case Verdict::NoPlan: return "no plan";
    case Verdict::UnknownRequest: return "unknown request";
    case Verdict::AnsweredTwice: return "answered twice";
    case Verdict::Late: return "late";
    case Verdict::TooLate: return "too late";
    case Verdict::Stopped: return "stopped";
    case Verdict::Shape: return "shape";
    case Verdict::Start: return "start";
    case Verdict::Join: return "join";
    case Verdict::End: return "end";
    case Verdict::Velocity: return "velocity";
    case Verdict::Acceleration: return "acceleration";
    case Verdict::Jerk: return "jerk";
    case Verdict::FlightBox: return "flight box";
  }
  return "unknown";
}

Adoption check_trajectory(const TimedSpline& trajectory, const HorizonRequest& request) {
  Adoption result = check_form(trajectory, request.t_s);
  if (is_refusal(result.verdict)) return result;
  const ClampedSpline spline = trajectory.spline();
  result = check_join(spline.sample(0.0), request.start);
  if (is_refusal(result.verdict)) return result;
  if (!spline.ends_at_rest()) return {Verdict::End, "the last three control points differ"};
  result = check_limits(motion_bounds(spline), request.limits);
  if (is_refusal(result.verdict)) return result;
  return check_flight_box(spline, grown(request.body, request.tube), request.flight_box);
}

}  // namespace tern
