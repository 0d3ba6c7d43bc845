#include "tests/support/rendered_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/random.h"

namespace tern::support {
namespace {

constexpr int kTexels = 1024;    ///< per period, a power of two
constexpr double kTexel = 0.01;  ///< m
constexpr int kLevels = 9;

/// A periodic texture, and its copies of half the size each.
class Texture {
 public:
  Texture() {
    Rng random(7);
    std::vector<float>& finest = levels_[0];
    finest.assign(std::size_t{kTexels} * kTexels, 0.0F);
    // Value noise of equal strength in each octave, from 2 to 128 texels.
    for (int cell = 2; cell <= 128; cell *= 2) {
      const int n = kTexels / cell;
      std::vector<float> values(idx(n * n));
      for (float& value : values) value = static_cast<float>(random.uniform(-1.0, 1.0));
      for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
          finest[idx(y * kTexels + x)] += smooth(values, n, (x + 0.5) / cell, (y + 0.5) / cell);
        }
      }
    }
    for (int level = 1; level < kLevels; ++level) halve(levels_[idx(level - 1)], levels_[idx(level)], kTexels >> level);
  }

  /// @param footprint  of a pixel on the surface, m
  [[nodiscard]] double at(double x, double y, double footprint) const {
    const double level = std::clamp(std::log2(std::max(footprint / kTexel, 1.0)), 0.0, kLevels - 1.001);
    const int low = static_cast<int>(level);
    const double share = level - low;
    return (1.0 - share) * sample(low, x, y) + share * sample(low + 1, x, y);
  }

 private:
  static float smooth(const std::vector<float>& values, int n, double x, double y) {
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double fx = x - i, fy = y - j, sx = fx * fx * (3.0 - 2.0 * fx), sy = fy * fy * (3.0 - 2.0 * fy);
    const auto value = [&](int a, int b) { return values[idx((b % n) * n + a % n)]; };
    return static_cast<float>((1.0 - sy) * ((1.0 - sx) * value(i, j) + sx * value(i + 1, j)) +
                              sy * ((1.0 - sx) * value(i, j + 1) + sx * value(i + 1, j + 1)));
  }
  static void halve(const std::vector<float>& from, std::vector<float>& to, int n) {
    to.resize(idx(n * n));
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const auto value = [&](int a, int b) { return from[idx((2 * y + b) * 2 * n + 2 * x + a)]; };
        to[idx(y * n + x)] = 0.25F * (value(0, 0) + value(1, 0) + value(0, 1) + value(1, 1));
      }
    }
  }
  [[nodiscard]] double sample(int level, double x, double y) const {
    const int n = kTexels >> level, mask = n - 1;
    const double size = kTexel * (1 << level), u = x / size - 0.5, v = y / size - 0.5;
    const double fu = std::floor(u), fv = std::floor(v);
    const int i = static_cast<int>(fu) & mask, j = static_cast<int>(fv) & mask;
    const int i1 = (i + 1) & mask, j1 = (j + 1) & mask;
    const float* t = levels_[idx(level)].data();
    const double a = u - fu, b = v - fv;
    return (1.0 - b) * ((1.0 - a) * t[j * n + i] + a * t[j * n + i1]) +
           b * ((1.0 - a) * t[j1 * n + i] + a * t[j1 * n + i1]);
  }

  std::array<std::vector<float>, kLevels> levels_;
};

const Texture& texture() {
  static const Texture the_texture;
  return the_texture;
}

/// The distances at which a ray enters and leaves a box, with the axes of these faces.
struct Slab {
  double enter = -1e30, leave = 1e30;
  int enter_axis = 0, leave_axis = 0;
};

Slab slab_of(const Box& box, const Vec3& from, const Vec3& inverse) {
  Slab slab;
  for (int axis = 0; axis < 3; ++axis) {
    double a = (box.min()[axis] - from[axis]) * inverse[axis], b = (box.max()[axis] - from[axis]) * inverse[axis];
    if (a > b) std::swap(a, b);
    if (a > slab.enter) slab.enter = a, slab.enter_axis = axis;
    if (b < slab.leave) slab.leave = b, slab.leave_axis = axis;
  }
  return slab;
}

struct Hit {
  double distance = 0.0;
  int box = -1, axis = 0;
};

Hit first_hit(const Box& hall, const std::vector<Box>& boxes, const Vec3& from, const Vec3& direction) {
  const Vec3 inverse = direction.cwiseInverse();
  const Slab walls = slab_of(hall, from, inverse);
  Hit hit{walls.leave, -1, walls.leave_axis};
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Slab slab = slab_of(boxes[k], from, inverse);
    if (slab.enter > slab.leave || slab.enter <= 0.0 || slab.enter >= hit.distance) continue;
    hit = {slab.enter, static_cast<int>(k), slab.enter_axis};
  }
  return hit;
}

std::vector<Box> boxes_at(const SceneGeometry& scene, double t) {
  std::vector<Box> boxes;
  for (const TexturedBox& box : scene.boxes) boxes.push_back(Box(box.at_start).translate(box.offset(t)));
  return boxes;
}

/// Normal noise by a table.
class Noise {
 public:
  Noise() {
    Rng random(11);
    for (double& value : table_) value = random.normal();
  }
  [[nodiscard]] double at(std::uint64_t key) const {
    key = (key ^ (key >> 31U)) * 0x9E3779B97F4A7C15ULL;
    return table_[(key >> 40U) % table_.size()];
  }

 private:
  std::array<double, 65536> table_{};
};

Eigen::Matrix3d forward_camera() {
  Eigen::Matrix3d R;
  R << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return R;
}

Result<StereoRig> rig_of(const CameraModel& left_model, const CameraModel& right_model) {
  const Eigen::Matrix3d twist =
      (Eigen::AngleAxisd(0.012, Vec3::UnitX()) * Eigen::AngleAxisd(-0.009, Vec3::UnitY())).toRotationMatrix();
  const MountedCamera left{left_model, forward_camera() * twist, Vec3(0.1, 0.055, 0.02)};
  const MountedCamera right{right_model, forward_camera() * twist.transpose(), Vec3(0.101, -0.055, 0.021)};
  return StereoRig::make(left, right);
}

CameraModel scaled(CameraModel model, double scale) {
  model.width = static_cast<int>(model.width * scale);
  model.height = static_cast<int>(model.height * scale);
  model.fx *= scale;
  model.fy *= scale;
  model.cx = (model.cx + 0.5) * scale - 0.5;
  model.cy = (model.cy + 0.5) * scale - 0.5;
  return model;
}

}  // namespace

SurfaceHit cast_ray(const SceneGeometry& scene, double t, const Vec3& from, const Vec3& direction) {
  const Hit hit = first_hit(scene.hall, boxes_at(scene, t), from, direction);
  return {hit.distance, hit.box, from + hit.distance * direction};
}

SceneCamera::SceneCamera(const MountedCamera& camera) : camera_(camera) {
  for (int v = 0; v < camera.model.height; ++v) {
    for (int u = 0; u < camera.model.width; ++u) {
      const auto at = camera.model.coordinates_of({u, v});
      rays_.push_back(at ? Vec3(at->x(), at->y(), 1.0) : Vec3(0.0, 0.0, 0.0));
    }
  }
}

GrayImage SceneCamera::render(const SceneGeometry& scene, double t, const Eigen::Matrix3d& R_WB, const Vec3& p_WB,
                              const Lighting& lighting) const {
  static const Noise noise;
  const CameraModel& model = camera_.model;
  const Eigen::Matrix3d R_WC = R_WB * camera_.R_BC;
  const Vec3 eye = p_WB + R_WB * camera_.p_BC;
  const std::vector<Box> boxes = boxes_at(scene, t);
  const auto frame = static_cast<std::uint64_t>(std::llround(t * 1e6) + std::llround(camera_.p_BC.y() * 1e4));
  GrayImage image{model.width, model.height, std::vector<std::uint8_t>(rays_.size())};
  for (std::size_t k = 0; k < rays_.size(); ++k) {
    const Vec3 ray = R_WC * rays_[k];
    double grey = 0.0;
    if (rays_[k].z() > 0.0) {
      const Hit hit = first_hit(scene.hall, boxes, eye, ray);
      Vec3 p = eye + hit.distance * ray;
      if (hit.box >= 0) p -= boxes[idx(hit.box)].min();
      const double slant = std::max(std::abs(ray[hit.axis]) / ray.norm(), 0.05);
      // A side of its own for each face: a shift by its number.
      const double shift = 3.1 * hit.axis + 1.7 * hit.box + (ray[hit.axis] > 0.0 ? 0.9 : 0.0);
      const double x = p[(hit.axis + 1) % 3] + shift, y = p[(hit.axis + 2) % 3] + 2.0 * shift;
      grey = 110.0 + 45.0 * lighting.contrast * texture().at(x, y, hit.distance / model.fx / slant);
    }
    grey = lighting.exposure * grey + lighting.noise * noise.at(frame * 1'000'003 + k);
    image.pixels[k] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
  }
  return image;
}

Result<StereoRig> euroc_like_rig(double scale) {
  CameraModel left{752, 480, 458.654, 457.296, 367.215, 248.375, LensModel::RadialTangential, {}};
  left.coefficients = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0};
  CameraModel right{752, 480, 457.587, 456.134, 379.999, 255.238, LensModel::RadialTangential, {}};
  right.coefficients = {-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05, 0.0};
  return rig_of(scaled(left, scale), scaled(right, scale));
}

Result<StereoRig> fisheye_rig(double scale) {
  CameraModel left{752, 480, 290.0, 290.2, 372.0, 241.0, LensModel::Equidistant, {0.003, 0.0007, -0.002, 0.0002, 0.0}};
  CameraModel right{
      752, 480, 291.0, 291.1, 380.0, 238.0, LensModel::Equidistant, {0.004, -0.0004, -0.001, 0.0001, 0.0}};
  return rig_of(scaled(left, scale), scaled(right, scale));
}

}  // namespace tern::support
