#include "simulator/inertial/tags.h"

namespace tern {

std::vector<PositionFix> TagSight::look(const CameraFrame& frame, const Vec3& body, UTime at) {
  std::vector<PositionFix> fixes;
  for (std::size_t k = 0; k < tags_.size(); ++k) {
    const VisualTag& tag = tags_[k];
    const SurfacePoint point{.p = tag.position};
    const double distance = (tag.position - frame.eye()).norm();
    if (distance > tag.range_m || !frame.see(point) || frame.hides(point)) continue;
    const double sigma = tag.sigma_m + tag.sigma_per_m * distance;
    const double x = rng_.normal(), y = rng_.normal(), z = rng_.normal();
    PositionFix fix;
    fix.at = at;
    fix.sensor_id = static_cast<std::int32_t>(k);
    fix.position = body + sigma * Vec3(x, y, z);
    fix.variance = Vec3::Constant(sigma * sigma);
    fixes.push_back(fix);
  }
  return fixes;
}

}  // namespace tern
