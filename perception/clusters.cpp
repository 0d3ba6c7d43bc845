#include "perception/clusters.h"

#include <cmath>

namespace tern {
namespace {

constexpr int kPending = -2;

}  // namespace

int neighbour(const PictureShape& shape, int u, int v) {
  if (v < 0 || v >= shape.rows) return -1;
  if (shape.wraps) u = u < 0 ? u + shape.columns : (u >= shape.columns ? u - shape.columns : u);
  return u < 0 || u >= shape.columns ? -1 : v * shape.columns + u;
}

void Clusters::begin(const DepthPicture& picture) {
  const DepthSensor& sensor = picture.sensor();
  const std::size_t pixels = idx(sensor.shape.pixels());
  group_of_.assign(pixels, kNone);
  order_.clear();
  groups_.clear();
  step_.resize(pixels);
  const bool is_lidar = sensor.shape.kind == PictureKind::Spherical;
  const double per_depth = is_lidar ? kStepPixels * sensor.shape.pixel_size() : 0.0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const float z = picture.depths()[static_cast<Eigen::Index>(pixel)];
    step_[pixel] = static_cast<float>(0.5 * (kStep + kStepSigmas * sensor.noise.sigma(z) + per_depth * z));
  }
}

void Clusters::split(const DepthPicture& picture, std::span<const int> pixels, int level) {
  for (const int pixel : pixels) group_of_[idx(pixel)] = kPending;
  for (const int pixel : pixels) {
    if (group_of_[idx(pixel)] == kPending) grow(picture, pixel, level);
  }
}

void Clusters::grow(const DepthPicture& picture, int seed, int level) {
  const PictureShape& shape = picture.shape();
  const int g = count();
  Group group{static_cast<int>(order_.size()), 0, level};
  group_of_[idx(seed)] = g;
  order_.push_back(seed);
  for (std::size_t k = idx(group.first); k < order_.size(); ++k) {
    const int pixel = order_[k];
    const int v = pixel / shape.columns, u = pixel - v * shape.columns;
    const float depth = picture.depths()[pixel];
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const int other = neighbour(shape, u + du, v + dv);
        if (other < 0 || group_of_[idx(other)] != kPending) continue;
        if (std::abs(picture.depths()[other] - depth) >= step_[idx(pixel)] + step_[idx(other)]) continue;
        group_of_[idx(other)] = g;
        order_.push_back(other);
      }
    }
  }
  group.count = static_cast<int>(order_.size()) - group.first;
  groups_.push_back(group);
}

}  // namespace tern
