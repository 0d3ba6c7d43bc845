#include "core/drawing/hull_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace tern {
namespace {

/// Returns the vertices in the plane through three of them, if all others are on one side; otherwise none.
std::vector<int> face_through(const Points& vertices, int a, int b, int c, double tolerance, Vec3& outward) {
  const Vec3 origin = vertices.col(a);
  outward = (vertices.col(b) - origin).cross(vertices.col(c) - origin);
  const double area = outward.norm();
  if (area <= tolerance * tolerance) return {};
  outward /= area;
  std::vector<int> face;
  bool above = false, below = false;
  for (int k = 0; k < vertices.cols(); ++k) {
    const double height = outward.dot(vertices.col(k) - origin);
    if (std::abs(height) <= tolerance) face.push_back(k);
    above = above || height > tolerance;
    below = below || height < -tolerance;
  }
  if (above) outward = -outward;
  return above != below ? face : std::vector<int>();
}

/// Sorts counter-clockwise around the outward normal.
void sort_around(const Points& vertices, const Vec3& outward, std::vector<int>& face) {
  Vec3 centre = Vec3::Zero();
  for (const int k : face) centre += vertices.col(k) / static_cast<double>(face.size());
  const Vec3 u = (vertices.col(face.front()) - centre).normalized(), v = outward.cross(u);
  const auto angle = [&](int k) {
    const Vec3 arm = vertices.col(k) - centre;
    return std::atan2(v.dot(arm), u.dot(arm));
  };
  std::sort(face.begin(), face.end(), [&](int a, int b) { return angle(a) < angle(b); });
}

}  // namespace

std::vector<std::array<int, 3>> hull_faces(const Points& vertices) {
  const int n = static_cast<int>(vertices.cols());
  if (n < 4) return {};
  const Vec3 size = vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff();
  const double tolerance = 1e-6 * size.norm();
  std::set<std::vector<int>> known;
  std::vector<std::array<int, 3>> triangles;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      for (int c = b + 1; c < n; ++c) {
        Vec3 outward;
        std::vector<int> face = face_through(vertices, a, b, c, tolerance, outward);
        if (face.empty() || !known.insert(face).second) continue;
        sort_around(vertices, outward, face);
        for (std::size_t k = 2; k < face.size(); ++k) triangles.push_back({face[0], face[k - 1], face[k]});
      }
    }
  }
  return triangles;
}

}  // namespace tern
