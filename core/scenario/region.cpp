#include "core/scenario/region.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

bool polygon_contains(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

double segment_distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (a + s * ab - p).norm();
}

double distance_to(const Box& box, const Vec3& p) { return box.exteriorDistance(p); }

double distance_to(const BallRegion& ball, const Vec3& p) {
  return std::max(0.0, (p - ball.centre).norm() - ball.radius);
}

double distance_to(const PrismRegion& prism, const Vec3& p) {
  const Eigen::Vector2d q = p.head<2>();
  double horizontal = 0.0;
  if (!polygon_contains(prism.corners, q)) {
    horizontal = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, j = prism.corners.size() - 1; i < prism.corners.size(); j = i++) {
      horizontal = std::min(horizontal, segment_distance(prism.corners[j], prism.corners[i], q));
    }
  }
  const double vertical = std::max({0.0, prism.z_min - p.z(), p.z() - prism.z_max});
  return std::sqrt(horizontal * horizontal + vertical * vertical);
}

Box bounds_of(const Box& box) { return box; }
Box bounds_of(const BallRegion& ball) { return box_around(ball.centre, Vec3::Constant(ball.radius)); }
Box bounds_of(const PrismRegion& prism) {
  Box box;
  for (const Eigen::Vector2d& c : prism.corners) {
    box.extend(Vec3(c.x(), c.y(), prism.z_min));
    box.extend(Vec3(c.x(), c.y(), prism.z_max));
  }
  return box;
}

}  // namespace

bool Region::contains(const Vec3& p) const { return distance(p) <= 0.0; }

double Region::distance(const Vec3& p) const {
  return std::visit([&](const auto& s) { return distance_to(s, p); }, shape);
}

Box Region::bounds() const {
  return std::visit([](const auto& s) { return bounds_of(s); }, shape);
}

}  // namespace tern
