#include "core/geometry/separation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/geometry/distance.h"
#include "core/geometry/separation_lp.h"

namespace tern {
namespace {

// Twice the rounding error of n·p + d in units of |p|₁ + |d|. The claims then hold in exact arithmetic and as any
// reader computes them.
constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

// Returns the plane across v that touches A from below, if every point of A and B confirms the required gap.
std::optional<Separation> verified(const Vec3& v, const Points& a, const Points& b, double clearance) {
  const Vec3 n = v / v.norm();
  double lowest_a = std::numeric_limits<double>::infinity();
  double highest_b = -lowest_a;
  double reach = 0.0;
  bool finite = true;
  for (const Points* points : {&a, &b}) {
    const double* p = points->data();
    for (Eigen::Index k = 0; k < points->cols(); ++k, p += 3) {
      const double height = n.x() * p[0] + n.y() * p[1] + n.z() * p[2];
      const double size = std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]);
      finite = finite && size < std::numeric_limits<double>::infinity();
      reach = std::max(reach, size);
      if (points == &a) lowest_a = std::min(lowest_a, height);
      if (points == &b) highest_b = std::max(highest_b, height);
    }
  }
  const double doubt = kRounding * reach;
  const double gap = lowest_a - highest_b - 2 * doubt;
  const double demanded = clearance + kTouchingTolerance - kPlaneMargin;
  if (!finite || !(gap >= demanded)) return std::nullopt;
  return Separation{{n, doubt - lowest_a}, gap};
}

}  // namespace

std::optional<Separation> separate(const Points& a, const Points& b, double clearance) {
  if (a.cols() == 0 || b.cols() == 0 || !(clearance >= 0.0)) {
    throw std::invalid_argument(
        fmt::format("separate: {} and {} points, clearance {} m", a.cols(), b.cols(), clearance));
  }
  const double limit = clearance + kTouchingTolerance - kPlaneMargin;
  const ShortestVector shortest = shortest_vector(a, b, limit);
  if (shortest.upper <= limit) {
    ++separation_counts().fast;
    return std::nullopt;
  }
  if (auto separation = verified(shortest.v, a, b, clearance)) {
    ++separation_counts().fast;
    return separation;
  }
  ++separation_counts().lp;
  const std::optional<Plane> plane = separate_by_lp(a, b);
  return plane ? verified(plane->n, a, b, clearance) : std::nullopt;
}

SeparationCounts& separation_counts() {
  thread_local SeparationCounts counts;
  return counts;
}

}  // namespace tern
