#include "perception/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tern {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Added to the σ of a bound, m: rounding of edges, and bias of the fit.
constexpr double kBoundSigma = 0.01;
/// The mean of n×n pixels with common noise has n times the σ of white noise. Faces of few blocks average less well
/// than their rays tell; faces that are cut into blocks at random average better: 0.6 n was measured.
constexpr double kPerBlock = 0.6;
constexpr double kLeastBad = 0.2;  ///< share of votes
constexpr int kLeastWhole = 2;     ///< votes
/// A ray passes a bound if it ends beyond it by more than this share of the ray's largest displacement along any axis.
constexpr float kLeastExcess = 0.2F;
/// A ray that passes no bound votes for the one ahead if it starts within this share of the extent from it.
constexpr float kBand = 0.3F;
constexpr int kLeastFitting = 6;  ///< rays

/// Bounds by number, as Sighting::bounds: −x, +x, −y, +y, −z, +z.
constexpr std::size_t kBounds = 6;
constexpr std::array<int, kBounds> kSide = {-1, 1, -1, 1, -1, 1};

/// The votes for one bound, and the innermost rays that passed beyond it. Coordinates times side, m.
struct Votes {
  std::array<int, idx(BoundSight::Unseen)> of{};
  float beyond = kInfinity;       ///< of rays that passed no other bound
  float near_corner = kInfinity;  ///< of all: such a ray may have missed the obstacle at its end along another axis

  [[nodiscard]] float innermost() const { return beyond < kInfinity ? beyond : near_corner; }

  [[nodiscard]] BoundSight verdict() const {
    int all = 0;
    for (const int n : of) all += n;
    if (all == 0) return BoundSight::Unseen;
    BoundSight worst = BoundSight::Occluded;
    for (const BoundSight sight : {BoundSight::Cut, BoundSight::Touching}) {
      if (of[idx(sight)] > of[idx(worst)]) worst = sight;
    }
    const int bad = of[idx(BoundSight::Occluded)] + of[idx(BoundSight::Cut)] + of[idx(BoundSight::Touching)];
    if (bad > kLeastBad * all) return worst;
    return of[idx(BoundSight::Whole)] >= kLeastWhole ? BoundSight::Whole : BoundSight::Unseen;
  }
};

/// The work on one cluster. Coordinates are relative to the sensor, axes of W.
class Surroundings {
 public:
  Surroundings(const DepthPicture& picture, const Clusters& clusters, int g, const Corner& corner)
      : picture_(picture), clusters_(clusters), group_(g), corner_(corner) {
    outermost.fill(-kInfinity);
    const PictureShape& shape = picture.shape();
    rotation_WC_ = picture.pose().q_WC.toRotationMatrix().cast<float>();
    columns_ = shape.columns;
  }

  /// Extremes of coordinate times side.
  void add_point(const ClusterRays& rays, std::size_t k) {
    for (std::size_t b = 0; b < kBounds; ++b) {
      const float at = static_cast<float>(kSide[b]) * rays.ray[b / 2][k] * rays.fitted[k];
      outermost[b] = std::max(outermost[b], at);
    }
  }

  /// The votes of the four neighbours of ray k.
  void ask_around(const ClusterRays& rays, std::size_t k) {
    const int pixel = rays.pixel[k], v = pixel / columns_, u = pixel - v * columns_;
    for (const auto& [du, dv] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int other = neighbour(picture_.shape(), u + du, v + dv);
      if (other >= 0 && clusters_.group_of(other) == group_) continue;
      vote(rays, k, other, ray_of(other, u + du, v + dv));
    }
  }

  std::array<float, kBounds> outermost{};
  std::array<Votes, kBounds> votes{};

 private:
  [[nodiscard]] Eigen::Vector3f ray_of(int pixel, int u, int v) const {
    if (pixel < 0) return rotation_WC_ * picture_.shape().ray(u, v).cast<float>();
    return picture_.rays_W().row(pixel).transpose();
  }

  /// The depth at which a ray beside ray k meets the continued face of ray k.
  [[nodiscard]] float continued(const ClusterRays& rays, std::size_t k, const Eigen::Vector3f& ray) const {
    const float here = rays.fitted[k];
    const int axis = static_cast<unsigned char>(rays.face[k]);  // ray k lies on a face
    const float depth = corner_.plane[idx(axis)] / ray[axis];
    return depth > 0.5F * here && depth < 2.0F * here ? depth : here;
  }

  [[nodiscard]] BoundSight judged(int pixel, float depth) const {
    if (pixel < 0) return BoundSight::Cut;
    const float measured = picture_.depths()[pixel];
    if (!(measured > kNotMeasured)) return BoundSight::Occluded;
    const float margin = kFitSigmas * picture_.sensor().noise.sigma(depth) + kFitMargin;
    if (measured >= picture_.range() && depth + margin >= picture_.range()) return BoundSight::Cut;
    if (measured > depth + margin) return BoundSight::Whole;
    return measured < depth - margin ? BoundSight::Occluded : BoundSight::Touching;
  }

  void vote(const ClusterRays& rays, std::size_t k, int pixel, const Eigen::Vector3f& ray) {
    const float depth = continued(rays, k, ray);
    const Passed passed = passed_by(rays, k, ray * depth);
    if (passed.bound == kBounds) return;
    const BoundSight sight = judged(pixel, depth);
    Votes& of = votes[passed.bound];
    ++of.of[idx(sight)];
    if (sight != BoundSight::Whole) return;
    of.near_corner = std::min(of.near_corner, passed.beyond);
    if (passed.is_alone) of.beyond = std::min(of.beyond, passed.beyond);
  }

  /// A bound that a way passes or leads to, how far out the way ends, and whether it passes no other bound.
  struct Passed {
    std::size_t bound = kBounds;
    float beyond = kInfinity;  ///< coordinate times side, m; infinity: it only leads there
    bool is_alone = false;
  };

  /// The bound that the way from ray k's point to another one passes first, or else the bound that it leads to.
  [[nodiscard]] Passed passed_by(const ClusterRays& rays, std::size_t k, const Eigen::Vector3f& to) const {
    std::array<float, kBounds> from{}, move{};  // times side
    for (std::size_t b = 0; b < kBounds; ++b) {
      from[b] = static_cast<float>(kSide[b]) * rays.ray[b / 2][k] * rays.fitted[k];
      move[b] = static_cast<float>(kSide[b]) * to[static_cast<Eigen::Index>(b / 2)] - from[b];
    }
    const float longest = *std::max_element(move.begin(), move.end());
    Passed passed;
    float earliest = kInfinity;
    int crossed = 0;
    for (std::size_t b = 0; b < kBounds; ++b) {
      const float inside = outermost[b] - from[b];
      crossed += move[b] > inside ? 1 : 0;
      if (move[b] - inside <= kLeastExcess * longest || inside >= earliest * move[b]) continue;
      earliest = inside / move[b];
      passed = {b, from[b] + move[b]};
    }
    passed.is_alone = crossed == 1;
    if (passed.bound < kBounds) return passed;
    for (std::size_t b = 0; b < kBounds; ++b) {
      const float extent = outermost[b] + outermost[b ^ 1U];
      if (move[b] >= longest && outermost[b] - from[b] < kBand * extent) return {b};
    }
    return passed;
  }

  const DepthPicture& picture_;
  const Clusters& clusters_;
  int group_;
  const Corner& corner_;
  Eigen::Matrix3f rotation_WC_;
  int columns_ = 0;
};

/// One bound of a sighting: its coordinate relative to the sensor, times the side.
struct Bound {
  double at = 0.0, sigma = 0.0;  ///< m
  BoundSight sight = BoundSight::Unseen;
};

bool is_bad(BoundSight sight) {
  return sight == BoundSight::Occluded || sight == BoundSight::Cut || sight == BoundSight::Touching;
}

/// Whole if the ends of a face along the other axes are seen; else the reason why not.
BoundSight beside(const std::array<Votes, kBounds>& votes, std::size_t axis) {
  for (std::size_t b = 0; b < kBounds; ++b) {
    const BoundSight verdict = votes[b].verdict();
    if (b / 2 != axis && is_bad(verdict)) return verdict;
    if (b / 2 != axis && verdict == BoundSight::Unseen) return BoundSight::Occluded;
  }
  return BoundSight::Whole;
}

Bound face_bound(const DepthPicture& picture, const Corner& corner, std::size_t axis,
                 const std::array<Votes, kBounds>& votes, std::size_t b, double depth) {
  const double pixel = picture.shape().pixel_size() * depth;
  const int block = picture.sensor().noise.block;
  const double spread = block > 1 ? kPerBlock * block : 1.0;
  Bound bound;
  bound.at = static_cast<double>(corner.side[axis]) * static_cast<double>(corner.plane[axis]);
  bound.sigma = spread * corner.sigma[axis] + kBoundSigma;
  if (corner.weak[axis]) bound.sigma += 0.5 * pixel;
  const double sigma = picture.sensor().noise.sigma(static_cast<float>(depth));
  if (depth + 2.0 * sigma > picture.range()) bound.sigma += sigma;
  bound.sight = BoundSight::Face;
  for (const BoundSight verdict : {votes[b].verdict(), corner.weak[axis] ? beside(votes, axis) : BoundSight::Whole}) {
    if (is_bad(verdict)) bound.sight = verdict;
  }
  return bound;
}

Bound end_bound(const Votes& votes, double outermost, double pixel, double face_error) {
  Bound bound;
  bound.sight = votes.verdict();
  bound.at = outermost;
  double gap = pixel;
  if (bound.sight == BoundSight::Whole && votes.innermost() < kInfinity) {
    gap = static_cast<double>(votes.innermost()) - outermost;
    bound.at += 0.5 * gap;
  }
  bound.sigma = std::sqrt(gap * gap / 12.0 + face_error * face_error) + kBoundSigma;
  return bound;
}

void set_bound(Sighting& sighting, std::size_t b, const Bound& bound, const Vec3& sensor) {
  const auto axis = static_cast<Eigen::Index>(b / 2);
  (kSide[b] < 0 ? sighting.lower : sighting.upper)[axis] = sensor[axis] + kSide[b] * bound.at;
  (kSide[b] < 0 ? sighting.lower_sigma : sighting.upper_sigma)[axis] = bound.sigma;
  sighting.bounds[b] = bound.sight;
}

/// The box of the points of a cluster to which no face fits.
Sighting unfitted(const DepthPicture& picture, const ClusterRays& rays) {
  Sighting sighting;
  Box box;
  double sigma = 0.0;
  for (std::size_t k = 0; k < rays.depth.size(); ++k) {
    box.extend(Vec3(rays.ray[0][k], rays.ray[1][k], rays.ray[2][k]) * static_cast<double>(rays.depth[k]));
    sigma = std::max(sigma, static_cast<double>(rays.sigma[k]));
  }
  sighting.lower = picture.pose().position + box.min();
  sighting.upper = picture.pose().position + box.max();
  sighting.lower_sigma = sighting.upper_sigma = Vec3::Constant(3.0 * sigma + kBoundSigma);
  sighting.bounds.fill(BoundSight::Occluded);
  sighting.points = rays.count();
  return sighting;
}

}  // namespace

Sighting bounds_of(const DepthPicture& picture, const Clusters& clusters, int g, const ClusterRays& rays,
                   const Corner& corner) {
  Surroundings around(picture, clusters, g, corner);
  int fitting = 0;
  double depth = 0.0, relative = 0.0;
  for (std::size_t k = 0; k < rays.depth.size(); ++k) {
    if (rays.face[k] == ClusterRays::kNoFace) continue;
    around.add_point(rays, k);
    ++fitting;
    depth += rays.fitted[k];
  }
  if (fitting < kLeastFitting) return unfitted(picture, rays);
  for (std::size_t k = 0; k < rays.depth.size(); ++k) {
    if (rays.face[k] != ClusterRays::kNoFace) around.ask_around(rays, k);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (corner.rays[a] > 0 && corner.side[a] != 0) {
      relative = std::max(relative, static_cast<double>(corner.sigma[a] / std::abs(corner.plane[a])));
    }
  }
  Sighting sighting;
  sighting.points = fitting;
  const double pixel = picture.shape().pixel_size() * depth / fitting;
  for (std::size_t b = 0; b < kBounds; ++b) {
    const bool is_face = corner.side[b / 2] == kSide[b] && corner.rays[b / 2] > 0;
    const double outermost = around.outermost[b];
    const Bound bound = is_face ? face_bound(picture, corner, b / 2, around.votes, b, depth / fitting)
                                : end_bound(around.votes[b], outermost, pixel, relative * std::abs(outermost));
    set_bound(sighting, b, bound, picture.pose().position);
  }
  sighting.lower = sighting.lower.cwiseMin(sighting.upper);
  return sighting;
}

}  // namespace tern
