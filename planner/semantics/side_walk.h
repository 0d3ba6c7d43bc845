// Walks along a ray through the columns of a SurfaceMap.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/semantics/surface_map.h"

namespace tern {

/// Beyond the extent of the surfaces there is open ground, m: more than a column.
inline constexpr double kBesideSurfaces = 2.0;

/// Returns the part of a ray, from its start on, that may meet columns other than open ground. It is from where the ray
/// enters the extent of the surfaces to where it leaves it, with kBesideSurfaces on each side. Both are 0 if it never
/// does.
inline std::pair<double, double> within_extent(const SurfaceMap& surfaces, const Vec3& eye,
                                               const Eigen::Vector2d& direction, double range) {
  if (surfaces.extent().isEmpty()) return {0.0, 0.0};
  double enter = 0.0, leave = range;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = surfaces.extent().min()[axis] - kBesideSurfaces - eye[axis];
    const double high = surfaces.extent().max()[axis] + kBesideSurfaces - eye[axis], d = direction[axis];
    if (std::abs(d) < 1e-9) {
      if (low > 0.0 || high < 0.0) return {0.0, 0.0};
      continue;
    }
    enter = std::max(enter, std::min(low / d, high / d));
    leave = std::min(leave, std::max(low / d, high / d));
  }
  return enter < leave ? std::pair(enter, leave) : std::pair(0.0, 0.0);
}

/// Calls visit(side, s, cosine) for each upright side that a horizontal ray meets, at distance s. The cosine is that of
/// the angle between ray and normal; sides along the ray are left out.
/// @param direction  unit. @return where the ray ends: at an opaque column at the eye's height, or at the range, m
template <class Visit>
double walk_sides(const SurfaceMap& surfaces, const Vec3& eye, const Eigen::Vector2d& direction, double range,
                  const Visit& visit) {
  const double step = 0.5 * SurfaceMap::kColumn;
  const SurfaceColumn* before = &surfaces.at(eye.x(), eye.y());
  int column = surfaces.column_of(eye.x(), eye.y());
  Eigen::Vector2d p_before = eye.head<2>();
  const auto [enter, leave] = within_extent(surfaces, eye, direction, range);
  const int steps = static_cast<int>(range / step);
  for (int k = std::max(1, static_cast<int>(enter / step)); k < steps && k * step <= leave; ++k) {
    const double s = k * step;
    const Eigen::Vector2d p = eye.head<2>() + s * direction;
    const int next = surfaces.column_of(p.x(), p.y());
    if (next == column) continue;
    column = next;
    const SurfaceColumn* now = &surfaces.at(p.x(), p.y());
    if (now->sides != before->sides) {
      // The side lies across the axis in which the density changes; at a corner, across the ray's main axis.
      const bool across_x = surfaces.at(p.x(), p_before.y()).sides != before->sides;
      const bool across_y = surfaces.at(p_before.x(), p.y()).sides != before->sides;
      const double cx = std::abs(direction.x()), cy = std::abs(direction.y());
      const double cosine = across_x == across_y ? std::max(cx, cy) : across_x ? cx : cy;
      if (cosine > 0.05) visit(now->sides > before->sides ? *now : *before, s, cosine);
    }
    const bool hides = now->is_opaque && now->low <= eye.z() && eye.z() <= now->high;
    if (hides) return s;
    before = now;
    p_before = p;
  }
  return range;
}

}  // namespace tern
