#include "core/geometry/convex_hull.h"

#include <CGAL/convex_hull_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/geometry/oriented_plane.h"

namespace tern {
namespace {

using Kernel = HullKernel;
using Point = HullPoint;
using Triangle = std::array<std::size_t, 3>;

// CGAL's traits with OrientedPlane. (The default traits of this overload have inexact planes and crash on flat sets.)
struct Traits : CGAL::Convex_hull_traits_3<Kernel, CGAL::Default, CGAL::Tag_true> {
  // NOLINTBEGIN(readability-identifier-naming): the concept's names
  using Plane_3 = OrientedPlane;
  struct Construct_plane_3 {
    OrientedPlane operator()(const Point& p, const Point& q, const Point& r) const { return {p, q, r}; }
  };
  struct Has_on_positive_side_3 {
    using result_type = bool;
    bool operator()(const OrientedPlane& plane, const Point& p) const { return plane.side(p) == CGAL::POSITIVE; }
  };
  struct Less_signed_distance_to_plane_3 {
    using result_type = bool;
    bool operator()(const OrientedPlane& plane, const Point& p, const Point& q) const { return plane.is_lower(p, q); }
  };
  [[nodiscard]] Construct_plane_3 construct_plane_3_object() const { return {}; }
  [[nodiscard]] Has_on_positive_side_3 has_on_positive_side_3_object() const { return {}; }
  [[nodiscard]] Less_signed_distance_to_plane_3 less_signed_distance_to_plane_3_object() const { return {}; }
  // NOLINTEND(readability-identifier-naming)
};

void check(const Points& points) {
  if (points.cols() == 0) throw std::invalid_argument("hull_vertices: no points");
  if (!points.allFinite()) {
    throw std::invalid_argument(fmt::format("hull_vertices: a coordinate of {} points is not finite", points.cols()));
  }
}

// Sorted by (x, y, z) without duplicates, so that the result does not depend on the order of the input.
std::vector<Point> sorted_distinct(const Points& points) {
  std::vector<Point> distinct;
  distinct.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index k = 0; k < points.cols(); ++k) distinct.emplace_back(points(0, k), points(1, k), points(2, k));
  std::ranges::sort(distinct);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return distinct;
}

// Returns two axes (i, j) onto which the plane of a triangle projects one to one.
std::array<int, 2> projection_axes(const Point& p, const Point& q, const Point& r) {
  constexpr std::array<std::array<int, 2>, 3> kChoices{{{0, 1}, {1, 2}, {0, 2}}};
  for (const auto& [i, j] : kChoices) {
    if (!CGAL::collinear(Kernel::Point_2(p[i], p[j]), Kernel::Point_2(q[i], q[j]), Kernel::Point_2(r[i], r[j]))) {
      return {i, j};
    }
  }
  throw std::logic_error("hull_vertices: a triangle that is not flat in space is flat in every projection");
}

// Andrew's monotone chain with strict turns only: points within an edge are left out.
std::vector<Point> flat_hull(std::vector<Point> points, const std::array<int, 2>& axes) {
  const auto flat = [&axes](const Point& p) { return Kernel::Point_2(p[axes[0]], p[axes[1]]); };
  std::ranges::sort(points, [&](const Point& p, const Point& q) { return flat(p) < flat(q); });
  std::vector<Point> chain;
  const auto extend = [&](const Point& p, std::size_t least) {
    while (chain.size() > least && !CGAL::left_turn(flat(chain[chain.size() - 2]), flat(chain.back()), flat(p))) {
      chain.pop_back();
    }
    chain.push_back(p);
  };
  for (const Point& p : points) extend(p, 1);
  const std::size_t least = chain.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, least);
  chain.pop_back();
  return chain;
}

struct HalfEdge {
  std::size_t from, to, opposite;
};

// Calls visit(edge) once for each edge of a triangulated surface: its smaller vertex `from`, the other one `to`, and
// the two vertices opposite to it.
template <class Visit>
void for_each_edge(const std::vector<Triangle>& faces, std::size_t vertices, const Visit& visit) {
  std::vector<std::size_t> begin(vertices + 1, 0);
  for (const auto& [p, q, r] : faces) {
    ++begin[std::min(p, q) + 1];
    ++begin[std::min(q, r) + 1];
    ++begin[std::min(r, p) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<HalfEdge> waiting(3 * faces.size());
  std::vector<std::size_t> count(vertices, 0);
  for (const auto& [p, q, r] : faces) {
    for (const HalfEdge& side : {HalfEdge{p, q, r}, HalfEdge{q, r, p}, HalfEdge{r, p, q}}) {
      const HalfEdge edge{std::min(side.from, side.to), std::max(side.from, side.to), side.opposite};
      HalfEdge* const first = &waiting[begin[edge.from]];
      HalfEdge* const last = first + count[edge.from];
      HalfEdge* const other = std::find_if(first, last, [&edge](const HalfEdge& e) { return e.to == edge.to; });
      if (other == last) {
        *last = edge;
        ++count[edge.from];
      } else {
        visit(edge, other->opposite);
      }
    }
  }
}

// CGAL's surface is triangulated, and vertices may lie inside flat faces and straight edges. At a corner the surface
// bends across at least three edges.
std::vector<Point> corners(const std::vector<Point>& vertices, const std::vector<Triangle>& faces) {
  std::vector<int> bends(vertices.size(), 0);
  for_each_edge(faces, vertices.size(), [&](const HalfEdge& edge, std::size_t other) {
    const OrientedPlane plane(vertices[edge.from], vertices[edge.to], vertices[edge.opposite]);
    if (plane.side(vertices[other]) == CGAL::ZERO) return;
    ++bends[edge.from];
    ++bends[edge.to];
  });
  std::vector<Point> result;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (bends[k] >= 3) result.push_back(vertices[k]);
  }
  return result;
}

// CGAL starts from the first three points that span a triangle. If they are far apart, fewer points lie outside of it.
void spread_first_three(std::vector<Point>& points) {
  const auto squared = [](const Kernel::Vector_3& v) { return v.squared_length(); };
  std::swap(points[1], points.back());
  const Kernel::Vector_3 axis = points[1] - points[0];
  const auto farthest = std::max_element(points.begin() + 2, points.end(), [&](const Point& p, const Point& q) {
    return squared(CGAL::cross_product(axis, p - points[0])) < squared(CGAL::cross_product(axis, q - points[0]));
  });
  std::swap(points[2], *farthest);
}

std::vector<Point> solid_hull(std::vector<Point> points) {
  spread_first_three(points);
  std::vector<Point> vertices;
  std::vector<Triangle> faces;
  CGAL::Convex_hull_3::internal::Indexed_triangle_set surface(vertices, faces);
  CGAL::convex_hull_3(points.begin(), points.end(), surface, Traits());
  return corners(vertices, faces);
}

std::vector<Point> hull(const std::vector<Point>& points) {
  const Point& first = points.front();
  const Point& last = points.back();
  const auto off_line = std::ranges::find_if(points, [&](const Point& p) { return !CGAL::collinear(first, last, p); });
  if (first == last) return {first};
  if (off_line == points.end()) return {first, last};
  const auto off_plane =
      std::ranges::find_if(points, [&](const Point& p) { return !CGAL::coplanar(first, last, *off_line, p); });
  if (off_plane == points.end()) return flat_hull(points, projection_axes(first, last, *off_line));
  return solid_hull(points);
}

}  // namespace

Points hull_vertices(const Points& points) {
  check(points);
  std::vector<Point> vertices = hull(sorted_distinct(points));
  std::ranges::sort(vertices);
  Points result(3, static_cast<Eigen::Index>(vertices.size()));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const Point& p = vertices[idx(k)];
    result.col(k) << p.x(), p.y(), p.z();
  }
  return result;
}

}  // namespace tern
