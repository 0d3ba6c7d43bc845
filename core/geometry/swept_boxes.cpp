#include "core/geometry/swept_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/gjk_simplex.h"
#include "core/geometry/separation.h"

namespace tern {
namespace {

using namespace gjk;

/// The support points of A − B.
class Pair {
 public:
  Pair(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points, const Points& vertices)
      : boxes_(boxes), points_(points.data()), count_(points.cols()), vertices_(vertices) {}

  /// The point of A − B lowest along v.
  [[nodiscard]] Vertex support(const Vec3& v) const {
    Vertex vertex;
    const Eigen::Index box = lowest_box(v);
    const CentredBox& lowest = boxes_[static_cast<std::size_t>(box)];
    vertex.i = 8 * box;
    for (int axis = 0; axis < 3; ++axis) {
      const bool up = v[axis] < 0.0;
      vertex.i += up ? Eigen::Index{1} << axis : 0;
      vertex.w[axis] = lowest.centre[axis] + (up ? lowest.half[axis] : -lowest.half[axis]);
    }
    vertex.j = highest(points_, count_, v);
    vertex.w -= Eigen::Map<const Vec3>(points_ + 3 * vertex.j);
    if (vertices_.cols() == 0) return vertex;
    const Eigen::Index of_body = highest(vertices_.data(), vertices_.cols(), v);
    vertex.w -= vertices_.col(of_body);
    vertex.j = vertex.j * vertices_.cols() + of_body;
    return vertex;
  }

  /// What n says of the boxes ⊕ (−vertices) and of the points, and the greatest |p|₁ of any of their points.
  struct Slab {
    double lowest_a, highest_b, reach;
  };
  [[nodiscard]] Slab slab(const Vec3& n) const {
    const CentredBox& lowest = boxes_[static_cast<std::size_t>(lowest_box(n))];
    Slab slab{n.dot(lowest.centre) - n.cwiseAbs().dot(lowest.half), 0.0, 0.0};
    double body = 0.0;
    for (Eigen::Index k = 0; k < vertices_.cols(); ++k) body = std::max(body, vertices_.col(k).lpNorm<1>());
    for (const CentredBox& b : boxes_) slab.reach = std::max(slab.reach, b.centre.lpNorm<1>() + b.half.sum() + body);
    for (Eigen::Index k = 0; k < count_; ++k) {
      slab.reach = std::max(slab.reach, Eigen::Map<const Vec3>(points_ + 3 * k).lpNorm<1>());
    }
    slab.highest_b = n.dot(Eigen::Map<const Vec3>(points_ + 3 * highest(points_, count_, n)));
    if (vertices_.cols() > 0) {
      slab.lowest_a -= n.dot(vertices_.col(highest(vertices_.data(), vertices_.cols(), n)));
    }
    return slab;
  }

 private:
  [[nodiscard]] Eigen::Index lowest_box(const Vec3& v) const {
    const Vec3 size = v.cwiseAbs();
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const double height = v.dot(boxes_[k].centre) - size.dot(boxes_[k].half);
      best = height < least ? k : best;
      least = height < least ? height : least;
    }
    return static_cast<Eigen::Index>(best);
  }

  static Eigen::Index highest(const double* p, Eigen::Index count, const Vec3& v) {
    Eigen::Index best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < count; ++k, p += 3) {
      const double height = v.x() * p[0] + v.y() * p[1] + v.z() * p[2];
      best = height > most ? k : best;
      most = height > most ? height : most;
    }
    return best;
  }

  std::span<const CentredBox> boxes_;
  const double* points_;
  Eigen::Index count_;
  const Points& vertices_;
};

/// Twice the rounding error of n·p + d in units of |p|₁ + |d|, as in separate().
constexpr double kPlaneRounding = 8 * std::numeric_limits<double>::epsilon();

/// Descends from the simplex of one vertex until A and B are proven to be no farther apart than limit, or, when any
/// proof will do, farther; else to the end. Leaves in v the direction of the proof, or the shortest vector.
Apart descend(const Pair& pair, Simplex simplex, double limit, bool any_proof, Vec3& v) {
  Nearest nearest = nearest_of(simplex);
  for (int step = 0; step < kMaxSteps && nearest.norm2 > limit * limit; ++step) {
    const Vertex vertex = pair.support(nearest.v);
    const double height = nearest.v.dot(vertex.w);
    if (any_proof && height > 0.0 && height * height > limit * limit * nearest.norm2) {
      v = nearest.v;
      return Apart::Yes;
    }
    if (nearest.norm2 - height <= kRelativeProgress * nearest.norm2 || contains(simplex, vertex)) break;
    Simplex grown = simplex;
    grown.vertices[static_cast<std::size_t>(grown.size++)] = vertex;
    const Nearest next = nearest_of(grown);
    if (next.size == 0) return Apart::No;
    if (!(next.norm2 < nearest.norm2)) break;
    simplex = face_of(grown, next);
    nearest = next;
  }
  v = nearest.v;
  return proven_distance(simplex, nearest) <= limit ? Apart::No : Apart::Doubt;
}

}  // namespace

Apart is_apart(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points, const Points& vertices,
               double clearance, Vec3& direction) {
  const double limit = clearance + kTouchingTolerance;
  const Pair pair(boxes, points, vertices);
  Simplex simplex;
  simplex.vertices[0] = pair.support(direction);
  simplex.size = 1;
  if (direction.dot(simplex[0]) > limit * direction.norm()) return Apart::Yes;
  Vec3 v;
  const Apart apart = descend(pair, simplex, limit, true, v);
  if (apart == Apart::Yes) direction = v;
  return apart;
}

std::optional<Separation> separate_sweep(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points,
                                         const Points& vertices, double clearance) {
  const double demanded = clearance + kTouchingTolerance - kPlaneMargin;
  const Pair pair(boxes, points, vertices);
  Simplex simplex;
  simplex.vertices[0] = pair.support(boxes[0].centre - points.col(0));
  simplex.size = 1;
  Vec3 v;
  if (descend(pair, simplex, demanded, false, v) == Apart::No) return std::nullopt;
  const Vec3 n = v / v.norm();
  const Pair::Slab slab = pair.slab(n);
  const double doubt = kPlaneRounding * slab.reach;
  const double gap = slab.lowest_a - slab.highest_b - 2 * doubt;
  if (!(gap >= demanded)) return std::nullopt;
  return Separation{{n, doubt - slab.lowest_a}, gap};
}

}  // namespace tern
