#include "mavlink/tracking_lag.h"

#include <algorithm>

namespace tern::mavlink {

void TrackingLag::add(double dt_s, const Vec3& p_c, const Vec3& v_c, const Vec3& p) {
  if (v_c.norm() < kMoving) return;
  moved_s_ += dt_s;
  const double now_s = (p_c - p).dot(v_c) / v_c.squaredNorm();
  lag_s_ += dt_s / std::max(dt_s, std::min(moved_s_, kOver)) * (now_s - lag_s_);
}

std::optional<double> TrackingLag::seconds() const {
  if (moved_s_ < 2.0 * kOver) return std::nullopt;
  return lag_s_;
}

}  // namespace tern::mavlink
