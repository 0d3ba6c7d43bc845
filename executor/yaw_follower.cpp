#include "executor/yaw_follower.h"

#include <algorithm>
#include <cmath>

#include "core/world/thrust.h"

namespace tern {
namespace {

/// In (−π, π].
double wrapped(double angle) {
  const double turn = std::remainder(angle, 2.0 * M_PI);
  return turn <= -M_PI ? M_PI : turn;
}

}  // namespace

YawFollower::YawFollower(double yaw, UTime now, const YawFollowerConfig& config)
    : rate_max_(to_radians(config.rate_max_deg_s)),
      acceleration_max_(to_radians(config.acceleration_max_deg_s2)),
      least_speed_(config.least_speed),
      yaw_(wrapped(yaw)),
      aim_(yaw_),
      at_(now) {}

double YawFollower::follow(const Vec3& v, UTime now) {
  const double h = (now - at_).seconds();
  if (h <= 0.0) return yaw_;
  at_ = now;
  if (v.head<2>().norm() >= least_speed_) aim_ = std::atan2(v.y(), v.x());
  const double error = wrapped(aim_ - yaw_);
  const double a = acceleration_max_;
  const double stops = std::sqrt(0.25 * a * a * h * h + 2.0 * a * std::abs(error)) - 0.5 * a * h;
  const double wanted = std::copysign(std::min({rate_max_, stops, std::abs(error) / h}), error);
  rate_ = std::clamp(wanted, rate_ - a * h, rate_ + a * h);
  yaw_ = wrapped(yaw_ + rate_ * h);
  return yaw_;
}

}  // namespace tern
