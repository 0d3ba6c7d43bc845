#include "planner/semantics/information_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/semantics/drift.h"
#include "planner/semantics/side_walk.h"

namespace tern {
namespace {

constexpr int kRings = 8;             ///< samples of the ground along a ray, at equal ratios of distance
constexpr int kHeights = 4;           ///< samples of an upright side
constexpr double kNearest = 0.5;      ///< surfaces nearer than this are not sampled, m
constexpr double kLeastHeight = 0.1;  ///< a camera lower than this sees no ground, m

/// Adds the upright side that a ray meets between two columns, at distance s.
void add_side(const SurfaceColumn& side, const Vec3& eye, const Eigen::Vector2d& direction, double cosine, double s,
              double width, const TextureCamera& camera, ViewInformation& view) {
  const double reach =
      std::min(s * std::tan(camera.half_height_rad), std::sqrt(std::max(0.0, camera.range_m * camera.range_m - s * s)));
  const double low = std::max(static_cast<double>(side.low), eye.z() - reach);
  const double high = std::min(static_cast<double>(side.high), eye.z() + reach);
  if (!(high > low)) return;
  const double dz = (high - low) / kHeights;
  for (int k = 0; k < kHeights; ++k) {
    const double z = low + (k + 0.5) * dz - eye.z();
    const double distance = std::sqrt(s * s + z * z);
    if (cosine * s < std::sin(camera.grazing_rad) * distance) continue;
    view.add({direction.x() * s, direction.y() * s, z}, side.sides * dz * s * width / cosine, camera);
  }
}

/// Adds the sides along a ray. Returns where it ends: at an opaque column, or at the camera's range, m.
double add_sides(const SurfaceMap& surfaces, const Vec3& eye, const Eigen::Vector2d& direction, double width,
                 const TextureCamera& camera, ViewInformation& view) {
  return walk_sides(surfaces, eye, direction, camera.range_m, [&](const SurfaceColumn& side, double s, double cosine) {
    if (s > kNearest) add_side(side, eye, direction, cosine, s, width, camera, view);
  });
}

void add_ground(const SurfaceMap& surfaces, const Vec3& eye, const Eigen::Vector2d& direction, double width,
                double until, const TextureCamera& camera, ViewInformation& view) {
  const double height = eye.z() - surfaces.ground_z();
  if (height < kLeastHeight || height >= camera.range_m) return;
  const double from = std::max(kNearest, height / std::tan(camera.half_height_rad));
  const double to = std::min(
      {until, height / std::tan(camera.grazing_rad), std::sqrt(camera.range_m * camera.range_m - height * height)});
  if (!(to > from)) return;
  const double ratio = std::pow(to / from, 1.0 / kRings);
  double inner = from;
  for (int k = 0; k < kRings; ++k) {
    const double outer = inner * ratio, s = 0.5 * (inner + outer);
    const SurfaceColumn& column = surfaces.at(eye.x() + s * direction.x(), eye.y() + s * direction.y());
    if (column.ground > 0.0f) {
      view.add({s * direction.x(), s * direction.y(), -height}, column.ground * s * width * (outer - inner), camera);
    }
    inner = outer;
  }
}

Eigen::Vector2d direction_of(int ray) {
  const double angle = 2.0 * std::numbers::pi * ray / InformationMap::kRays;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

ViewInformation look_along(const SurfaceMap& surfaces, const Vec3& eye, const Eigen::Vector2d& direction, double width,
                           const TextureCamera& camera) {
  ViewInformation view;
  const double end = add_sides(surfaces, eye, direction, width, camera, view);
  add_ground(surfaces, eye, direction, width, end, camera, view);
  return view;
}

InformationMap::InformationMap(const SurfaceMap& surfaces, const Box& domain, std::vector<double> heights,
                               const TextureCamera& camera)
    : camera_(camera),
      blind_growth_(sighted_growth(frame_sigma({}, camera).translation_m, camera.frame_s)),
      x0_(domain.min().x()),
      y0_(domain.min().y()),
      heights_(std::move(heights)) {
  const auto lines = [this](double length) { return std::ceil(length / step_) + 1.0; };
  const Vec3 extent = domain.sizes();
  const auto layers = static_cast<double>(heights_.size());
  while (lines(extent.x()) * lines(extent.y()) * layers > kMaxPlaces) step_ *= 1.05;
  inverse_step_ = 1.0 / step_;
  x_edge_ = x0_ - 0.5 * step_;
  y_edge_ = y0_ - 0.5 * step_;
  nx_ = static_cast<int>(lines(extent.x()));
  ny_ = static_cast<int>(lines(extent.y()));
  sights_.reserve(heights_.size() * idx(nx_) * idx(ny_) * kRays);
  for (const double z : heights_) {
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) look_around(surfaces, {x0_ + x * step_, y0_ + y * step_, z});
    }
  }
}

void InformationMap::look_around(const SurfaceMap& surfaces, const Vec3& eye) {
  const double width = 2.0 * std::numbers::pi / kRays;
  std::vector<ViewInformation> rays;
  rays.reserve(kRays);
  for (int k = 0; k < kRays; ++k) rays.push_back(look_along(surfaces, eye, direction_of(k), width, camera_));
  const int beside = static_cast<int>(std::lround(camera_.view_rad / width - 1.0)) / 2;  // rays on each side
  const double edge = 0.5 * (camera_.view_rad / width - (2 * beside + 1));  // share of the rays at the edges
  int best = 0;
  for (int heading = 0; heading < kRays; ++heading) {
    ViewInformation view;
    for (int k = -beside; k <= beside; ++k) view += rays[idx((heading + k + kRays) % kRays)];
    for (const int k : {-beside - 1, beside + 1}) {
      const ViewInformation& ray = rays[idx((heading + k + kRays) % kRays)];
      view += {edge * ray.information, edge * ray.landmarks};
    }
    const FrameSigma sigma = frame_sigma(view, camera_);
    const double growth = sighted_growth(sigma.translation_m, camera_.frame_s);
    sights_.push_back({static_cast<float>(growth), static_cast<float>(equal_dark_time(growth)),
                       static_cast<float>(sigma.translation_m), static_cast<float>(sigma.rotation_rad)});
    const std::size_t first = sights_.size() - 1 - idx(heading);
    if (sights_.back().growth < sights_[first + idx(best)].growth) best = heading;
  }
  best_.push_back(static_cast<std::uint8_t>(best));
}

const Sight& InformationMap::sight(const Vec3& p, double x, double y) const { return sight(p, heading_of(x, y)); }

int InformationMap::heading_of(double x, double y) {
  if (x == 0.0 && y == 0.0) return kBest;
  return static_cast<int>(std::lround(std::atan2(y, x) * (kRays / (2.0 * std::numbers::pi))));
}

}  // namespace tern
