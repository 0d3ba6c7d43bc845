#include "core/drawing/plane_place.h"

#include <algorithm>
#include <cmath>

namespace tern {

Vec3 place_of(const CertificatePlane& plane, const TimedSpline& trajectory, UTime t_s) {
  const ClampedSpline spline = trajectory.spline();
  const double passed = std::max((t_s - trajectory.start).seconds(), 0.0) / spline.interval_s();
  const double from = plane.interval == 0 ? passed : std::floor(passed) + plane.interval;
  const double to = std::floor(passed) + plane.interval + 1;
  return spline.sample(spline.interval_s() * (from + (plane.part + 0.5) / plane.parts * (to - from))).p;
}

}  // namespace tern
