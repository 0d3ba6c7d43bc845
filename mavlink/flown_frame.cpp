#include "mavlink/flown_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mavlink/axes.h"

namespace tern::mavlink {

std::optional<OdometryOffset> FrameJumps::add(UTime at, const Vec3& p, const Vec3& v, double yaw, bool reset) {
  const std::optional<Seen> before = std::exchange(last_, Seen{at, p, v, yaw, 0.0});
  if (!before) return std::nullopt;
  const double dt = (at - before->at).seconds();
  if (!reset) {
    last_->yaw_rate = dt > 0.0 ? wrapped(yaw - before->yaw) / dt : before->yaw_rate;
    return std::nullopt;
  }
  last_->yaw_rate = before->yaw_rate;
  OdometryOffset jump;
  jump.yaw = wrapped(yaw - before->yaw - dt * before->yaw_rate);
  jump.translation = p - jump.rotation() * (before->p + dt * before->v);
  return jump;
}

OdometryOffset composed(const OdometryOffset& second, const OdometryOffset& first) {
  return {second.to_W(PointInO{first.translation}).xyz, wrapped(second.yaw + first.yaw), first.epoch};
}

void FlownFrame::add(const UavState& estimate, int resets) {
  if (last_ && estimate.at <= *last_) return;
  const MotionSample& m = estimate.motion;
  const bool reset = last_ && resets != resets_;
  resets_ = resets;
  const double dt = last_ ? (estimate.at - *last_).seconds() : 0.0;
  last_ = estimate.at;
  if (const auto jump = frame_.add(estimate.at, m.p, m.v, estimate.yaw, reset)) ahead_ = composed(*jump, ahead_);
  follow(estimate, dt);
  if (outstanding_ <= kMost && std::abs(ahead_.yaw) <= kMostTurn) return;
  ahead_ = {};
  outstanding_ = 0.0;
  ++jumps_;
}

/// The frame turns about the vehicle, so a turn alone does not move it.
void FlownFrame::follow(const UavState& estimate, double dt) {
  const Vec3& p = estimate.motion.p;
  const Vec3 flown = ahead_.to_O(PointInW{p}).xyz, left = p - flown;
  const auto within = [dt](double speed, double way) { return way > speed * dt ? speed * dt / way : 1.0; };
  const double share = std::min(within(kSpeed, left.norm()), within(kTurn, std::abs(ahead_.yaw)));
  outstanding_ = (1.0 - share) * left.norm();
  if (share == 1.0) {
    ahead_ = {};
    return;
  }
  ahead_.yaw *= 1.0 - share;
  ahead_.translation = p - ahead_.rotation() * (flown + share * left);
}

UavState FlownFrame::flown(UavState estimate) const {
  if (is_followed()) return estimate;
  MotionSample& m = estimate.motion;
  m.p = ahead_.to_O(PointInW{m.p}).xyz;
  m.v = ahead_.to_O(VectorInW{m.v}).xyz;
  estimate.yaw = wrapped(estimate.yaw - ahead_.yaw);
  return estimate;
}

MotionSample FlownFrame::commanded(const MotionSample& flown) const {
  if (is_followed()) return flown;
  MotionSample m = flown;
  m.p = ahead_.to_W(PointInO{m.p}).xyz;
  for (Vec3* const x : {&m.v, &m.a, &m.j}) *x = ahead_.to_W(VectorInO{*x}).xyz;
  return m;
}

}  // namespace tern::mavlink
