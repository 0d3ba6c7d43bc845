#include "tests/support/rendered_flight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tern::support {

VioPath circling(double seconds, double speed) {
  constexpr double kRadius = 3.5;
  const double rate = speed / kRadius;
  // It speeds up over two seconds.
  const auto ramp = [](double t) { return t < 2.0 ? 0.5 * (1.0 - std::cos(0.5 * std::numbers::pi * t)) : 1.0; };
  const auto phase = [rate](double t) {
    if (t <= 0.0) return 0.0;
    return rate * (t < 2.0 ? 0.5 * t - std::sin(0.5 * std::numbers::pi * t) / std::numbers::pi : t - 1.0);
  };
  VioPath path;
  path.velocity = [=](double t) {
    const double s = phase(t);
    return Vec3(-speed * ramp(t) * std::sin(s), speed * ramp(t) * std::cos(s), 0.3 * ramp(t) * std::sin(0.7 * t));
  };
  path.yaw = [=](double t) { return phase(t) + 0.5 * std::numbers::pi; };
  path.start = Vec3(kRadius, 0.0, 1.5);
  path.duration = seconds;
  return path;
}

SceneGeometry hall_with_box(bool has_mover) {
  SceneGeometry scene;
  scene.boxes.push_back({Box(Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0))});
  if (has_mover) {
    const auto around = [](double t) {
      return Vec3(5.0 * std::cos(0.5 * t + 0.5), 5.0 * std::sin(0.5 * t + 0.5), 0.0);
    };
    scene.boxes.push_back({Box(Vec3(-0.7, -0.7, 0.5), Vec3(0.7, 0.7, 2.5)), around});
  }
  return scene;
}

SceneRig::SceneRig(const StereoRig& rig, SceneGeometry scene)
    : rig_(rig), scene_(std::move(scene)), left_(rig.left()), right_(rig.right()) {}

ImagePair SceneRig::see(double t, const NavState& truth, const Lighting& lighting) const {
  return {left_.render(scene_, t, truth.R, truth.p, lighting), right_.render(scene_, t, truth.R, truth.p, lighting)};
}

ImagePair SceneRig::blurred(double t, const std::vector<NavState>& states) const {
  std::vector<int> left, right;
  ImagePair pair;
  for (const NavState& state : states) {
    pair = see(t, state);
    left.resize(pair.left.pixels.size());
    right.resize(pair.right.pixels.size());
    for (std::size_t k = 0; k < left.size(); ++k) left[k] += pair.left.pixels[k];
    for (std::size_t k = 0; k < right.size(); ++k) right[k] += pair.right.pixels[k];
  }
  const int count = static_cast<int>(states.size());
  for (std::size_t k = 0; k < left.size(); ++k) pair.left.pixels[k] = static_cast<std::uint8_t>(left[k] / count);
  for (std::size_t k = 0; k < right.size(); ++k) pair.right.pixels[k] = static_cast<std::uint8_t>(right[k] / count);
  return pair;
}

void TrackJudge::judge(double t, const NavState& truth, const FeatureFrame& frame) {
  const StereoRig& rig = rig_.rig();
  const Eigen::Matrix3d R_WC = truth.R * rig.R_BC();
  const Vec3 p_WC = truth.p + truth.R * rig.left().p_BC;
  for (const StereoFeature& feature : frame.features) {
    ++features;
    with_right += feature.has_right ? 1 : 0;
    const int age = ++ages[feature.id];
    auto [birth, is_new] = births_.try_emplace(feature.id);
    if (is_new) {
      const Vec3 ray(feature.left.x(), feature.left.y(), 1.0);
      birth->second = {cast_ray(rig_.scene(), t, p_WC, R_WC * ray), t};
    }
    const auto& [hit, born] = birth->second;
    Vec3 point = hit.p_W;
    if (hit.box >= 0) {
      const TexturedBox& box = rig_.scene().boxes[idx(hit.box)];
      point += box.offset(t) - box.offset(born);
    }
    if (hit.box == 1 && age >= 3) ++on_mover;
    if (age > kFrames) continue;
    const Vec3 x = R_WC.transpose() * (point - p_WC), x_right = x - Vec3(rig.baseline(), 0.0, 0.0);
    const auto error = [&](const Eigen::Vector2d& seen, const Vec3& at) {
      return Eigen::Vector2d(rig.focal() * (seen - Eigen::Vector2d(at.head<2>() / at.z())));
    };
    if (!is_new) {
      const Eigen::Vector2d e = error(feature.left, x);
      ++views;
      outliers += e.norm() > kOutlierPx ? 1 : 0;
      left.insert(left.end(), {std::abs(e.x()), std::abs(e.y())});
    }
    if (feature.has_right) {
      const Eigen::Vector2d e = error(feature.right, x_right);
      right.insert(right.end(), {std::abs(e.x()), std::abs(e.y())});
    }
  }
}

double quantile(std::vector<double> values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + k);
  return values[idx(k)];
}

}  // namespace tern::support
