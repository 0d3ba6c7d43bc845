#include "core/geometry/distance.h"

#include <cmath>
#include <limits>

#include "core/geometry/gjk_simplex.h"

namespace tern {
namespace {

using namespace gjk;

Eigen::Index lowest(const Points& points, const Vec3& direction) {
  const double* p = points.data();
  Eigen::Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < points.cols(); ++i, p += 3) {
    const double height = direction.x() * p[0] + direction.y() * p[1] + direction.z() * p[2];
    best = height < least ? i : best;
    least = height < least ? height : least;
  }
  return best;
}

Vertex support(const Points& a, const Points& b, const Vec3& v) {
  Vertex vertex;
  vertex.i = lowest(a, v);
  vertex.j = lowest(b, -v);
  vertex.w = a.col(vertex.i) - b.col(vertex.j);
  return vertex;
}

}  // namespace

ShortestVector shortest_vector(const Points& a, const Points& b, double enough) {
  const auto support_along = [&](const Vec3& v) { return support(a, b, v); };
  const Descent d = descend(support_along, support(a, b, a.col(0) - b.col(0)), enough, kNoProof);
  if (d.overlaps) return {};
  return {d.nearest.v, d.lowest / std::sqrt(d.nearest.norm2), proven_distance(d.simplex, d.nearest)};
}

double distance(const Points& a, const Points& b) { return shortest_vector(a, b, 0.0).upper; }

}  // namespace tern
