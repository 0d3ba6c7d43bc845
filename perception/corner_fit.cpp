#include "perception/corner_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

/// The extra width of the gate in each turn, m. The first turns bridge the distance of the quantiles from the faces.
constexpr std::array<float, 7> kGates = {0.25F, 0.25F, 0.12F, 0.05F, 0.0F, 0.0F, 0.0F};
constexpr std::array<float, 3> kLastGates = {0.05F, 0.0F, 0.0F};
constexpr float kGateMargin = 0.02F;  ///< m
/// Quantiles are taken from at most about this many points.
constexpr int kSample = 200;
constexpr double kQuantile = 0.1;
constexpr int kLeastRays = 6;
constexpr double kLeastShare = 0.04;
/// A face is needed if χ² would grow by this without it, of which one ray adds at most kMostOfRay.
constexpr double kNeeded = 25.0, kMostOfRay = 9.0;
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

void assign(ClusterRays& rays, const Corner& corner, float margin) {
  for (int k = 0; k < rays.count(); ++k) {
    const auto [depth, axis] = rays.meet(corner, k);
    const bool fits = std::abs(rays.depth[idx(k)] - depth) <= kFitSigmas * rays.sigma[idx(k)] + margin;
    rays.fitted[idx(k)] = depth;
    rays.face[idx(k)] = fits ? axis : ClusterRays::kNoFace;
  }
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

void CornerFitter::start(const ClusterRays& rays, Corner& corner) {
  const int stride = std::max(1, rays.count() / kSample);
  for (std::size_t a = 0; a < 3; ++a) {
    sorted_.clear();
    for (int k = 0; k < rays.count(); k += stride) sorted_.push_back(rays.depth[idx(k)] * rays.ray[a][idx(k)]);
    const auto low = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(sorted_.size() - 1));
    const auto high = static_cast<std::ptrdiff_t>(sorted_.size()) - 1 - low;
    std::nth_element(sorted_.begin(), sorted_.begin() + low, sorted_.end());
    const float least = sorted_[idx(low)];
    std::nth_element(sorted_.begin(), sorted_.begin() + high, sorted_.end());
    const float most = sorted_[idx(high)];
    corner.side[a] = least > 0.0F ? -1 : (most < 0.0F ? 1 : 0);
    corner.plane[a] = corner.side[a] < 0 ? least : most;
  }
}

void CornerFitter::turn(ClusterRays& rays, Corner& corner, float gate) {
  assign(rays, corner, gate);
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

bool CornerFitter::is_needed(const ClusterRays& rays, const Corner& corner, int axis, double block) const {
  Corner others = corner;
  others.side[idx(axis)] = 0;
  double growth = 0.0;
  for (int k = 0; k < rays.count(); ++k) {
    if (rays.face[idx(k)] != axis) continue;
    const double sigma = rays.sigma[idx(k)];
    const double with = (rays.depth[idx(k)] - rays.fitted[idx(k)]) / sigma;
    const auto [depth, face] = rays.meet(others, k);
    const double without = face == ClusterRays::kNoFace ? kMostOfRay : (rays.depth[idx(k)] - depth) / sigma;
    growth += std::min(without * without, kMostOfRay) - std::min(with * with, kMostOfRay);
  }
  return growth > kNeeded * block * block;
}

/// The axis of the weakest face without support, or −1. The last face is never named.
int CornerFitter::unsupported(const DepthPicture& picture, const ClusterRays& rays, const Corner& corner) const {
  if (corner.faces() < 2) return -1;
  const int least = std::max(kLeastRays, static_cast<int>(kLeastShare * rays.count()));
  int weakest = -1;
  for (int a = 0; a < 3; ++a) {
    if (corner.side[idx(a)] == 0) continue;
    const bool holds = corner.rays[idx(a)] >= least && !span_of(picture.shape(), rays, a).is_thin() &&
                       is_needed(rays, corner, a, picture.sensor().noise.block);
    if (!holds && (weakest < 0 || corner.rays[idx(a)] < corner.rays[idx(weakest)])) weakest = a;
  }
  return weakest;
}

Corner CornerFitter::fit(const DepthPicture& picture, ClusterRays& rays) {
  Corner corner;
  start(rays, corner);
  for (const float gate : kGates) turn(rays, corner, kGateMargin + gate);
  for (int weakest = unsupported(picture, rays, corner); weakest >= 0; weakest = unsupported(picture, rays, corner)) {
    corner.side[idx(weakest)] = 0;
    for (const float gate : kLastGates) turn(rays, corner, kGateMargin + gate);
  }
  assign(rays, corner, kFitMargin);
  if (corner.faces() == 1) {
    for (int a = 0; a < 3; ++a) {
      if (corner.side[idx(a)] != 0) corner.thin = span_of(picture.shape(), rays, a).is_thin();
    }
  }
  return corner;
}

}  // namespace tern
