#include "core/world/heading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/world/thrust.h"
#include "core/world/vehicle.h"

namespace tern {
namespace {

constexpr std::size_t kMinYawPoints = 7, kMaxYawPoints = kMaxIntervals + 3;

ClampedSpline along_x(const PlanHeading& heading) {
  Points points = Points::Zero(3, static_cast<Eigen::Index>(heading.control_points.size()));
  points.row(0) = Eigen::Map<const Eigen::RowVectorXd>(heading.control_points.data(), points.cols());
  return {std::move(points), heading.interval.seconds()};
}

HeadingBreachReport shape_breach(const PlanHeading& heading) {
  const std::size_t points = heading.control_points.size();
  if (points < kMinYawPoints || points > kMaxYawPoints) {
    return {HeadingBreach::Shape, fmt::format("{} control points, not {} to {}", points, kMinYawPoints, kMaxYawPoints)};
  }
  if (heading.interval <= Duration{0}) {
    return {HeadingBreach::Shape, fmt::format("interval of {} us", heading.interval.us)};
  }
  if (!std::ranges::all_of(heading.control_points, [](double yaw) { return std::isfinite(yaw); })) {
    return {HeadingBreach::Shape, "a control point is not finite"};
  }
  return {};
}

HeadingBreachReport join_breach(const YawSample& start, const YawSample& before) {
  const double turn = std::abs(wrapped_yaw(start.yaw - before.yaw)), faster = std::abs(start.rate - before.rate);
  if (turn <= kYawJoinTolerance && faster <= kYawJoinTolerance) return {};
  return {HeadingBreach::Join,
          fmt::format("differs from the heading before by {:.3g} rad and {:.3g} rad/s, more than {:.0e}", turn, faster,
                      kYawJoinTolerance)};
}

}  // namespace

double wrapped_yaw(double yaw) {
  const double turn = std::remainder(yaw, 2.0 * std::numbers::pi);
  return turn <= -std::numbers::pi ? std::numbers::pi : turn;
}

HeadingSpline::HeadingSpline(const PlanHeading& heading)
    : start_(heading.start), interval_(heading.interval), yaw_(along_x(heading)) {}

UTime HeadingSpline::end() const { return start_ + interval_ * yaw_.intervals(); }

YawSample HeadingSpline::sample(UTime t) const {
  const MotionSample s = yaw_.sample(std::max(0.0, (t - start_).seconds()));
  return {s.p.x(), s.v.x()};
}

double HeadingSpline::largest_rate() const { return motion_bounds(yaw_).v_max.x(); }

double HeadingSpline::largest_acceleration() const { return motion_bounds(yaw_).a_max.x(); }

const char* to_string(HeadingBreach breach) {
  constexpr const char* kNames[kHeadingBreaches] = {"none", "shape", "end", "rate", "acceleration", "join"};
  return kNames[static_cast<int>(breach)];
}

HeadingBreachReport heading_breach(const PlanHeading& heading, const HeadingLimits& limits,
                                   const std::optional<YawSample>& before) {
  constexpr double kMore = 1.0 + kLimitTolerance;
  if (auto report = shape_breach(heading); !report.ok()) return report;
  const std::vector<double>& points = heading.control_points;
  if (points.back() != points[points.size() - 2]) return {HeadingBreach::End, "the last two control points differ"};
  const HeadingSpline spline(heading);
  const double rate = to_degrees(spline.largest_rate());
  if (!(rate <= limits.rate_max_deg_s * kMore)) {
    return {HeadingBreach::Rate, fmt::format("{:.9g} deg/s beyond {:.9g}", rate, limits.rate_max_deg_s)};
  }
  const double acceleration = to_degrees(spline.largest_acceleration());
  if (!(acceleration <= limits.acceleration_max_deg_s2 * kMore)) {
    return {HeadingBreach::Acceleration,
            fmt::format("{:.9g} deg/s2 beyond {:.9g}", acceleration, limits.acceleration_max_deg_s2)};
  }
  return before ? join_breach(spline.sample(spline.start()), *before) : HeadingBreachReport{};
}

}  // namespace tern
