#include "perception/rasterizer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace tern {
namespace {

/// Mixes three numbers into a seed (splitmix64): neighbouring frames and sensors are independent.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

std::uint64_t frame_seed(std::uint64_t seed, int sensor, std::int64_t frame) {
  return mixed(mixed(mixed(seed) + static_cast<std::uint64_t>(sensor)) + static_cast<std::uint64_t>(frame));
}

/// Standard normal numbers, both of each pair of the polar method.
void fill_normal(Rng& rng, std::vector<float>& numbers) {
  for (std::size_t k = 0; k < numbers.size();) {
    const double u = rng.uniform(-1.0, 1.0);
    const double v = rng.uniform(-1.0, 1.0);
    const double s = u * u + v * v;
    if (s <= 0.0 || s >= 1.0) continue;
    const double scale = std::sqrt(-2.0 * std::log(s) / s);
    numbers[k++] = static_cast<float>(u * scale);
    if (k < numbers.size()) numbers[k++] = static_cast<float>(v * scale);
  }
}

float as_measured(float depth, const DepthSensor& sensor) {
  if (depth >= static_cast<float>(sensor.range_m)) return static_cast<float>(sensor.range_m);
  return depth < static_cast<float>(sensor.least_range_m) ? kNotMeasured : depth;
}

}  // namespace

void Rasterizer::begin(DepthPicture& picture, const SensorPose& pose) {
  picture.move_to(pose);
  slabs_.prepare(picture);
}

void Rasterizer::add(DepthPicture& picture, const Box& box) {
  float* const depths = picture.depths().data();
  slabs_.visit(picture, box, [&](int first, int count, const float* enter, const float* leave) {
    for (int k = 0; k < count; ++k) {
      const float depth = std::max(enter[k], 0.0F);
      if (enter[k] <= leave[k] && leave[k] >= 0.0F && depth < depths[first + k]) depths[first + k] = depth;
    }
  });
}

void Rasterizer::add_ground(DepthPicture& picture, double ground_z) {
  const auto below = static_cast<float>(ground_z - picture.pose().position.z());
  if (below >= 0.0F) return void(picture.depths().setConstant(kNotMeasured));
  for (int pixel = 0; pixel < picture.shape().pixels(); ++pixel) {
    const float d_z = picture.rays_W()(pixel, 2);
    if (d_z >= 0.0F) continue;
    picture.depths()[pixel] = std::min(picture.depths()[pixel], below / d_z);
  }
}

void Rasterizer::end(DepthPicture& picture) {
  for (float& depth : picture.depths()) depth = as_measured(depth, picture.sensor());
}

void add_noise(DepthPicture& picture, std::uint64_t seed, int sensor, std::int64_t frame) {
  const DepthNoise& noise = picture.sensor().noise;
  const PictureShape& shape = picture.shape();
  Rng rng(frame_seed(seed, sensor, frame));
  const int block = noise.block;
  const int shift_u = static_cast<int>(rng.uniform() * block), shift_v = static_cast<int>(rng.uniform() * block);
  const int across = (shape.columns + shift_u + block - 1) / block, down = (shape.rows + shift_v + block - 1) / block;
  std::vector<float> normal(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  fill_normal(rng, normal);
  for (int v = 0, pixel = 0; v < shape.rows; ++v) {
    for (int u = 0; u < shape.columns; ++u, ++pixel) {
      if (!picture.is_surface(pixel)) continue;
      float& depth = picture.depths()[pixel];
      const float n = normal[idx((v + shift_v) / block * across + (u + shift_u) / block)];
      depth = as_measured(depth + noise.sigma(depth) * n, picture.sensor());
    }
  }
}

}  // namespace tern
