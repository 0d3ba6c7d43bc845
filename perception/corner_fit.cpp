#include "perception/corner_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

/// How much farther the gate reaches towards the sensor in each turn, m. The first turns bridge the distance of the
/// quantiles from the faces. They never reach away from the sensor, where another object may be.
constexpr std::array<float, 7> kGates = {0.25F, 0.25F, 0.12F, 0.05F, 0.0F, 0.0F, 0.0F};
constexpr std::array<float, 3> kLastGates = {0.05F, 0.0F, 0.0F};
/// The gate: wider ones let a surface behind pull the face away, as soon as that is 5σ behind.
constexpr float kGateSigmas = 2.0F, kGateMargin = 0.02F;  // m
/// Quantiles are taken from at most about this many points.
constexpr int kSample = 200;
constexpr double kQuantile = 0.1;
constexpr int kLeastRays = 12;
constexpr double kLeastShare = 0.04;
/// A face is needed if χ² would grow by this without it, of which one ray adds at most kMostOfRay. It is needed as well
/// if kLeastMisfits more rays would not fit.
constexpr double kNeeded = 25.0, kMostOfRay = 9.0;
constexpr int kLeastMisfits = 6;
/// A cluster of which fewer rays fit is fitted anew, from its nearest parts.
constexpr double kGoodShare = 0.9;
constexpr std::array<double, 2> kParts = {0.4, 0.15};
/// Rays with a smaller mean component across a face graze it, pixels: one pixel then spans a third of the depth.
constexpr double kGrazing = 3.0;
/// Smaller components count as this, so that inverses stay finite.
constexpr float kLeastComponent = 1e-5F;

float inverse_of(float d) { return 1.0F / (std::abs(d) < kLeastComponent ? std::copysign(kLeastComponent, d) : d); }

/// The columns and rows that the rays of one face span.
struct Span {
  int least_u = std::numeric_limits<int>::max(), most_u = std::numeric_limits<int>::min();
  int least_v = least_u, most_v = most_u;
  void add(int u, int v) {
    least_u = std::min(least_u, u);
    most_u = std::max(most_u, u);
    least_v = std::min(least_v, v);
    most_v = std::max(most_v, v);
  }
  [[nodiscard]] bool is_thin() const { return most_u <= least_u || most_v <= least_v; }
};

Span span_of(const PictureShape& shape, const ClusterRays& rays, int axis) {
  Span span;
  for (int k = 0; k < rays.count(); ++k) {
    if (rays.face[idx(k)] != axis) continue;
    span.add(rays.pixel[idx(k)] % shape.columns, rays.pixel[idx(k)] / shape.columns);
  }
  return span;
}

/// Rays that are nearer than the corner may be off by `nearer` (m) more than the others.
void assign(ClusterRays& rays, const Corner& corner, float sigmas, float margin, float nearer = 0.0F) {
  for (int k = 0; k < rays.count(); ++k) {
    const auto [depth, axis] = rays.meet(corner, k);
    const float off = rays.depth[idx(k)] - depth, most = sigmas * rays.sigma[idx(k)] + margin;
    const bool fits = off <= most && off >= -most - nearer;
    rays.fitted[idx(k)] = depth;
    rays.face[idx(k)] = fits ? axis : ClusterRays::kNoFace;
  }
}

void turn(ClusterRays& rays, Corner& corner, float nearer) {
  assign(rays, corner, kGateSigmas, kGateMargin, nearer);
  std::array<double, 3> weights{}, sums{};
  corner.rays = {};
  for (std::size_t k = 0; k < rays.depth.size(); ++k) {
    if (rays.face[k] == ClusterRays::kNoFace) continue;
    const auto a = idx(rays.face[k]);
    const double root = static_cast<double>(rays.inverse[a][k] / rays.sigma[k]);
    weights[a] += root * root;
    sums[a] += root * root * static_cast<double>(rays.depth[k] * rays.ray[a][k]);
    ++corner.rays[a];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (corner.side[a] == 0 || corner.rays[a] == 0) continue;
    corner.plane[a] = static_cast<float>(sums[a] / weights[a]);
    corner.sigma[a] = static_cast<float>(1.0 / std::sqrt(weights[a]));
  }
}

bool is_needed(const ClusterRays& rays, const Corner& corner, int axis, int block) {
  Corner others = corner;
  others.side[idx(axis)] = 0;
  double growth = 0.0;
  int misfits = 0;
  for (int k = 0; k < rays.count(); ++k) {
    if (rays.face[idx(k)] != axis) continue;
    const double sigma = rays.sigma[idx(k)];
    const double with = (rays.depth[idx(k)] - rays.fitted[idx(k)]) / sigma;
    const auto [depth, face] = rays.meet(others, k);
    const double off = rays.depth[idx(k)] - depth;
    if (std::abs(off) > kFitSigmas * sigma + kFitMargin) ++misfits;
    const double without = face == ClusterRays::kNoFace ? kMostOfRay : off / sigma;
    growth += std::min(without * without, kMostOfRay) - std::min(with * with, kMostOfRay);
  }
  return misfits >= kLeastMisfits || growth > kNeeded * block * block;
}

/// The axis of the face with the fewest rays among those that are not needed, or −1. The last face is never named.
int unneeded(const ClusterRays& rays, const Corner& corner, int block) {
  if (corner.faces() < 2) return -1;
  int weakest = -1;
  for (int a = 0; a < 3; ++a) {
    if (corner.side[idx(a)] == 0 || is_needed(rays, corner, a, block)) continue;
    if (weakest < 0 || corner.rays[idx(a)] < corner.rays[idx(weakest)]) weakest = a;
  }
  return weakest;
}

bool is_weak(const PictureShape& shape, const ClusterRays& rays, const Corner& corner, int axis) {
  if (corner.side[idx(axis)] == 0) return false;
  if (corner.rays[idx(axis)] < std::max(kLeastRays, static_cast<int>(kLeastShare * corner.fitting))) return true;
  double across = 0.0;
  for (std::size_t k = 0; k < rays.depth.size(); ++k) {
    if (rays.face[k] == axis) across += std::abs(rays.ray[idx(axis)][k]);
  }
  return across < kGrazing * shape.pixel_size() * corner.rays[idx(axis)] || span_of(shape, rays, axis).is_thin();
}

}  // namespace

void ClusterRays::gather(const DepthPicture& picture, std::span<const int> pixels) {
  const std::size_t n = pixels.size();
  pixel.assign(pixels.begin(), pixels.end());
  depth.resize(n);
  sigma.resize(n);
  fitted.resize(n);
  face.assign(n, kNoFace);
  const DepthNoise& noise = picture.sensor().noise;
  for (std::size_t k = 0; k < n; ++k) {
    depth[k] = picture.depths()[pixels[k]];
    sigma[k] = noise.sigma(depth[k]) + kLeastSigma;
  }
  for (int a = 0; a < 3; ++a) {
    ray[idx(a)].resize(n);
    inverse[idx(a)].resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      ray[idx(a)][k] = picture.rays_W()(pixels[k], a);
      inverse[idx(a)][k] = inverse_of(ray[idx(a)][k]);
    }
  }
}

std::pair<float, std::int8_t> ClusterRays::meet(const Corner& corner, int k) const {
  float deepest = 0.0F;
  std::int8_t face_axis = kNoFace;
  for (std::size_t a = 0; a < 3; ++a) {
    if (corner.side[a] == 0) continue;
    const float z = corner.plane[a] * inverse[a][idx(k)];
    if (z > deepest) {
      deepest = z;
      face_axis = static_cast<std::int8_t>(a);
    }
  }
  return {deepest, face_axis};
}

Corner CornerFitter::start(const ClusterRays& rays, float most_depth) {
  Corner corner;
  const int stride = std::max(1, rays.count() / kSample);
  for (std::size_t a = 0; a < 3; ++a) {
    sorted_.clear();
    for (std::size_t k = 0; k < rays.depth.size(); k += idx(stride)) {
      if (rays.depth[k] <= most_depth) sorted_.push_back(rays.depth[k] * rays.ray[a][k]);
    }
    if (sorted_.empty()) return corner;
    const auto low = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(sorted_.size() - 1));
    const auto high = static_cast<std::ptrdiff_t>(sorted_.size()) - 1 - low;
    std::nth_element(sorted_.begin(), sorted_.begin() + low, sorted_.end());
    const float least = sorted_[idx(low)];
    std::nth_element(sorted_.begin(), sorted_.begin() + high, sorted_.end());
    const float most = sorted_[idx(high)];
    corner.side[a] = least > 0.0F ? -1 : (most < 0.0F ? 1 : 0);
    corner.plane[a] = corner.side[a] < 0 ? least : most;
  }
  return corner;
}

float CornerFitter::depth_quantile(const ClusterRays& rays, double share) {
  sorted_ = rays.depth;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted_.size() - 1));
  std::nth_element(sorted_.begin(), sorted_.begin() + at, sorted_.end());
  return sorted_[idx(at)];
}

Corner CornerFitter::fit_from(Corner corner, ClusterRays& rays, int block) {
  for (const float gate : kGates) turn(rays, corner, gate);
  for (int axis = unneeded(rays, corner, block); axis >= 0; axis = unneeded(rays, corner, block)) {
    corner.side[idx(axis)] = 0;
    for (const float gate : kLastGates) turn(rays, corner, gate);
  }
  assign(rays, corner, kFitSigmas, kFitMargin);
  corner.fitting = corner.rays[0] + corner.rays[1] + corner.rays[2];
  return corner;
}

Corner CornerFitter::fit(const DepthPicture& picture, ClusterRays& rays) {
  const int block = picture.sensor().noise.block;
  Corner best = fit_from(start(rays, std::numeric_limits<float>::infinity()), rays, block);
  for (const double part : kParts) {
    if (best.fitting >= kGoodShare * rays.count()) break;
    const Corner other = fit_from(start(rays, depth_quantile(rays, part)), rays, block);
    if (other.fitting > best.fitting) best = other;
  }
  assign(rays, best, kFitSigmas, kFitMargin);
  for (int a = 0; a < 3; ++a) best.weak[idx(a)] = is_weak(picture.shape(), rays, best, a);
  return best;
}

}  // namespace tern
