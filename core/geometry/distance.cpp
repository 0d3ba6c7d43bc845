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
  Simplex simplex;
  simplex.vertices[0] = support(a, b, a.col(0) - b.col(0));
  simplex.size = 1;
  Nearest nearest = nearest_of(simplex);
  double lowest_height = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps && nearest.norm2 > enough * enough; ++step) {
    const Vertex vertex = support(a, b, nearest.v);
    lowest_height = nearest.v.dot(vertex.w);
    if (nearest.norm2 - lowest_height <= kRelativeProgress * nearest.norm2 || contains(simplex, vertex)) break;
    Simplex grown = simplex;
    grown.vertices[static_cast<std::size_t>(grown.size++)] = vertex;
    const Nearest next = nearest_of(grown);
    if (next.size == 0) return {};
    if (!(next.norm2 < nearest.norm2)) break;
    simplex = face_of(grown, next);
    nearest = next;
    lowest_height = -std::numeric_limits<double>::infinity();
  }
  return {nearest.v, lowest_height / std::sqrt(nearest.norm2), proven_distance(simplex, nearest)};
}

double distance(const Points& a, const Points& b) { return shortest_vector(a, b, 0.0).upper; }

}  // namespace tern
