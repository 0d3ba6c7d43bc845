#include "core/geometry/swept_boxes.h"

#include <algorithm>
#include <limits>

#include "core/geometry/gjk_simplex.h"

namespace tern {
namespace {

using namespace gjk;

/// The support points of A − B.
class Difference {
 public:
  Difference(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points, const Points& vertices)
      : boxes_(boxes), points_(points.data()), count_(points.cols()), vertices_(vertices) {}

  /// The point of A − B lowest along v.
  [[nodiscard]] Vertex operator()(const Vec3& v) const {
    Vertex vertex;
    const Eigen::Index box = lowest_box(v);
    const CentredBox& lowest = boxes_[idx(box)];
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

  /// The extrema of n·p over the boxes ⊕ (−vertices) and over the points, and the largest |p|₁ of both.
  struct Slab {
    double lowest_a, highest_b, reach;
  };
  [[nodiscard]] Slab slab(const Vec3& n) const {
    const CentredBox& lowest = boxes_[idx(lowest_box(n))];
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

}  // namespace

IsSeparated is_separated(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points,
                         const Points& vertices, double clearance, Vec3& direction) {
  const double limit = clearance + kTouchingTolerance;
  const Difference difference(boxes, points, vertices);
  const Vertex first = difference(direction);
  if (direction.dot(first.w) > limit * direction.norm()) return IsSeparated::Yes;
  const Descent d = descend(difference, first, limit, limit);
  if (d.is_farther) direction = d.nearest.v;
  if (d.is_farther) return IsSeparated::Yes;
  return d.overlaps || proven_distance(d.simplex, d.nearest) <= limit ? IsSeparated::No : IsSeparated::Doubt;
}

std::optional<Separation> separate_sweep(std::span<const CentredBox> boxes, const Eigen::Ref<const Points>& points,
                                         const Points& vertices, double clearance) {
  const double demanded = clearance + kTouchingTolerance - kPlaneMargin;
  const Difference difference(boxes, points, vertices);
  const Descent d = descend(difference, difference(boxes[0].centre - points.col(0)), demanded, kNoProof);
  if (d.overlaps || proven_distance(d.simplex, d.nearest) <= demanded) return std::nullopt;
  const Vec3 n = d.nearest.v / d.nearest.v.norm();
  const Difference::Slab slab = difference.slab(n);
  const double doubt = kPlaneRounding * slab.reach;
  const double gap = slab.lowest_a - slab.highest_b - 2 * doubt;
  if (!(gap >= demanded)) return std::nullopt;
  return Separation{{n, doubt - slab.lowest_a}, gap};
}

}  // namespace tern
