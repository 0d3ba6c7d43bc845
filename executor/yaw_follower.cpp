#include "executor/yaw_follower.h"

#include <algorithm>
#include <cmath>

#include "core/world/thrust.h"
#include "core/world/vehicle.h"

namespace tern {

YawFollower::YawFollower(double yaw, UTime now, const YawFollowerConfig& config)
    : rate_max_(to_radians(config.rate_max_deg_s)),
      acceleration_max_(to_radians(config.acceleration_max_deg_s2)),
      least_speed_(config.least_speed),
      yaw_(wrapped_yaw(yaw)),
      aim_(yaw_),
      at_(now) {}

double YawFollower::follow(const Vec3& v, UTime now) {
  const double h = (now - at_).seconds();
  if (h <= 0.0) return yaw_;
  at_ = now;
  if (v.head<2>().norm() >= least_speed_) aim_ = std::atan2(v.y(), v.x());
  const double error = wrapped_yaw(aim_ - yaw_);
  const double a = acceleration_max_;
  const double stops = std::sqrt(0.25 * a * a * h * h + 2.0 * a * std::abs(error)) - 0.5 * a * h;
  const double wanted = std::copysign(std::min({rate_max_, stops, std::abs(error) / h}), error);
  rate_ = std::clamp(wanted, rate_ - a * h, rate_ + a * h);
  yaw_ = wrapped_yaw(yaw_ + rate_ * h);
  return yaw_;
}

double YawFollower::follow(const YawSample& planned, UTime now, const HeadingLimits& limits) {
  const double h = (now - at_).seconds();
  if (h <= 0.0) return yaw_;
  at_ = now;
  aim_ = wrapped_yaw(planned.yaw);
  const double a = to_radians(limits.acceleration_max_deg_s2), rate_max = to_radians(limits.rate_max_deg_s);
  const double change = a * h * (1.0 + kLimitTolerance);
  const double error = wrapped_yaw(aim_ - yaw_), mean = error / h;
  if (std::abs(mean) <= rate_max * (1.0 + kLimitTolerance) && std::abs(mean - rate_) <= change &&
      std::abs(planned.rate - mean) <= change) {
    yaw_ = aim_;
    rate_ = planned.rate;
    return yaw_;
  }
  const double behind = error - planned.rate * h;  // the error that is left if the yaw turns as the heading does
  const double stops = std::sqrt(0.25 * a * a * h * h + 2.0 * a * std::abs(behind)) - 0.5 * a * h;
  const double faster = std::copysign(std::min(stops, std::abs(behind) / h), behind);
  const double wanted = std::clamp(planned.rate + faster, -rate_max, rate_max);
  rate_ = std::clamp(wanted, rate_ - a * h, rate_ + a * h);
  yaw_ = wrapped_yaw(yaw_ + rate_ * h);
  return yaw_;
}

}  // namespace tern
