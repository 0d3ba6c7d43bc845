#include "planner/global_path/local_goal.h"

#include <cmath>
#include <optional>

namespace tern {
namespace {

/// Returns the last point of the segment ab on the sphere. @pre b is outside it
std::optional<Vec3> last_exit(const Vec3& a, const Vec3& b, const Vec3& centre, double radius) {
  // ‖a + t d − centre‖² = radius² for the larger root t.
  const Vec3 d = b - a;
  const Vec3 m = a - centre;
  const double half_b = m.dot(d);
  const double d2 = d.squaredNorm();
  const double discriminant = half_b * half_b - d2 * (m.squaredNorm() - radius * radius);
  if (d2 <= 0.0 || discriminant < 0.0) return std::nullopt;
  const double t = (-half_b + std::sqrt(discriminant)) / d2;
  if (t < 0.0 || t > 1.0) return std::nullopt;
  return a + t * d;
}

}  // namespace

Vec3 local_goal(const std::vector<Vec3>& path, const Vec3& start, double radius) {
  if ((path.back() - start).norm() <= radius) return path.back();
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    if (const auto exit = last_exit(path[i - 1], path[i], start, radius)) return *exit;
  }
  return start + (path.front() - start).normalized() * radius;
}

}  // namespace tern
