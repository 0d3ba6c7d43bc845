// The descent over support points of Gilbert, Johnson and Keerthi, shared by distance.cpp and swept_boxes.cpp.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/base/types.h"

namespace tern::gjk {

// A descent over polytopes ends after a few steps; a longer one repeats itself because of rounding errors.
inline constexpr int kMaxSteps = 48;
// A step makes no progress if v·v − v·w is at most this fraction of v·v.
inline constexpr double kRelativeProgress = 1e-12;
// Bound of the rounding error of n·p in units of |n|₁|p|₁, including the error of n = e × f.
inline constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// A support point of A − B.
struct Vertex {
  Vec3 w;  // a.col(i) − b.col(j)
  Eigen::Index i = 0, j = 0;
};

// One to four support points.
struct Simplex {
  std::array<Vertex, 4> vertices;
  int size = 0;
  const Vec3& operator[](int k) const { return vertices[idx(k)].w; }
};

// The point of the simplex nearest to the origin, and the face that it lies on.
struct Nearest {
  Vec3 v = Vec3::Zero();
  double norm2 = std::numeric_limits<double>::infinity();
  std::array<int, 3> face{};        // indices of the face's vertices
  std::array<double, 3> weights{};  // their barycentric weights, not normalised
  int size = 0;                     // vertices of the face: 1 vertex, 2 edge, 3 triangle

  void offer(const Nearest& other) {
    if (other.norm2 < norm2) *this = other;
  }
};

inline void offer_vertex(const Simplex& s, int p, Nearest& best) {
  best.offer({s[p], s[p].squaredNorm(), {p, 0, 0}, {1.0, 0.0, 0.0}, 1});
}

// Computes v = e × (p × e) / e·e instead of p + t e: it is orthogonal to e to the last bits, even if |v| ≪ |p|.
inline void offer_edge(const Simplex& s, int p, int q, Nearest& best) {
  const Vec3 e = s[q] - s[p];
  const double ee = e.squaredNorm();
  const double t = -s[p].dot(e);
  if (!(t > 0.0)) return offer_vertex(s, p, best);
  if (!(t < ee)) return offer_vertex(s, q, best);
  const Vec3 v = e.cross(s[p].cross(e)) / ee;
  best.offer({v, v.squaredNorm(), {p, q, 0}, {ee - t, t, 0.0}, 2});
}

// @pre n = (q − p) × (r − p)
inline void offer_triangle(const Simplex& s, int p, int q, int r, const Vec3& n, Nearest& best) {
  const double weight_p = s[q].cross(s[r]).dot(n);
  const double weight_q = s[r].cross(s[p]).dot(n);
  const double weight_r = s[p].cross(s[q]).dot(n);
  if (weight_p > 0.0 && weight_q > 0.0 && weight_r > 0.0) {
    const Vec3 v = n * (n.dot(s[p]) / n.squaredNorm());
    best.offer({v, v.squaredNorm(), {p, q, r}, {weight_p, weight_q, weight_r}, 3});
    return;
  }
  if (!(weight_r > 0.0)) offer_edge(s, p, q, best);
  if (!(weight_q > 0.0)) offer_edge(s, r, p, best);
  if (!(weight_p > 0.0)) offer_edge(s, q, r, best);
}

// True if the origin lies on the inner side of the face through p with normal n by more than the rounding error.
inline bool surely_inside(const Vec3& n, const Vec3& p, const Vec3& opposite) {
  const double origin_side = -n.dot(p);
  const double inner_side = n.dot(opposite - p);
  const double doubt = kRounding * n.lpNorm<1>() * (p.lpNorm<1>() + opposite.lpNorm<1>());
  return origin_side > 0.0 ? origin_side > doubt && inner_side > doubt : origin_side < -doubt && inner_side < -doubt;
}

// Returns size 0 if the origin lies inside the tetrahedron. If rounding leaves a face in doubt, the origin counts as
// outside of it; a flat tetrahedron therefore contains no point.
inline Nearest nearest_of_tetrahedron(const Simplex& s) {
  constexpr std::array<std::array<int, 4>, 4> kFaces{{{3, 0, 1, 2}, {3, 1, 2, 0}, {3, 2, 0, 1}, {0, 1, 2, 3}}};
  Nearest best;
  for (const auto& [p, q, r, opposite] : kFaces) {
    const Vec3 n = (s[q] - s[p]).cross(s[r] - s[p]);
    if (!surely_inside(n, s[p], s[opposite])) offer_triangle(s, p, q, r, n, best);
  }
  return best;
}

inline Nearest nearest_of(const Simplex& s) {
  Nearest best;
  if (s.size == 4) return nearest_of_tetrahedron(s);
  if (s.size == 3) offer_triangle(s, 2, 0, 1, (s[0] - s[2]).cross(s[1] - s[2]), best);
  if (s.size == 2) offer_edge(s, 1, 0, best);
  if (s.size == 1) offer_vertex(s, 0, best);
  return best;
}

inline Simplex face_of(const Simplex& s, const Nearest& nearest) {
  Simplex face;
  face.size = nearest.size;
  for (std::size_t k = 0; k < static_cast<std::size_t>(nearest.size); ++k) {
    face.vertices[k] = s.vertices[idx(nearest.face[k])];
  }
  return face;
}

// Returns |Σ λ_k w_k|. Unlike |v| this is the distance of two points of the hulls even if the simplex is very thin.
inline double proven_distance(const Simplex& face, const Nearest& nearest) {
  Vec3 point = Vec3::Zero();
  double sum = 0.0;
  for (int k = 0; k < face.size; ++k) {
    point += nearest.weights[idx(k)] * face[k];
    sum += nearest.weights[idx(k)];
  }
  return point.norm() / sum;
}

inline bool contains(const Simplex& s, const Vertex& vertex) {
  for (int k = 0; k < s.size; ++k) {
    const Vertex& other = s.vertices[idx(k)];
    if (other.i == vertex.i && other.j == vertex.j) return true;
  }
  return false;
}

// The state at the end of a descent.
struct Descent {
  Simplex simplex;  // the face nearest to the origin
  Nearest nearest;
  // v·w of the support point along nearest.v; −∞ if none was computed.
  double lowest = -std::numeric_limits<double>::infinity();
  bool overlaps = false;    // the origin lies inside the simplex
  bool is_farther = false;  // the distance is proven to exceed `proof`
};

// The value of `proof` for a caller that needs the distance itself: no lower bound of the distance ends the descent.
inline constexpr double kNoProof = std::numeric_limits<double>::infinity();

// Runs the descent from one support point of A − B; support(v) returns the point of A − B that is lowest along v. The
// descent ends if the distance (m) is known to be at most `enough` or proven to exceed `proof`, or if rounding
// prevents progress.
template <class Support>
Descent descend(const Support& support, const Vertex& first, double enough, double proof) {
  Descent d;
  d.simplex.vertices[0] = first;
  d.simplex.size = 1;
  d.nearest = nearest_of(d.simplex);
  for (int step = 0; step < kMaxSteps && d.nearest.norm2 > enough * enough; ++step) {
    const Vertex vertex = support(d.nearest.v);
    d.lowest = d.nearest.v.dot(vertex.w);
    d.is_farther = d.lowest > 0.0 && d.lowest * d.lowest > proof * proof * d.nearest.norm2;
    if (d.is_farther) break;
    if (d.nearest.norm2 - d.lowest <= kRelativeProgress * d.nearest.norm2 || contains(d.simplex, vertex)) break;
    Simplex grown = d.simplex;
    grown.vertices[idx(grown.size++)] = vertex;
    const Nearest next = nearest_of(grown);
    d.overlaps = next.size == 0;
    if (d.overlaps || !(next.norm2 < d.nearest.norm2)) break;
    d.simplex = face_of(grown, next);
    d.nearest = next;
    d.lowest = -std::numeric_limits<double>::infinity();
  }
  return d;
}

}  // namespace tern::gjk
