// The sight of a camera from each place in each direction, as labels promise it; prepared once per goal field.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "planner/semantics/camera_information.h"
#include "planner/semantics/surface_map.h"

namespace tern {

/// The sight from one place in one direction.
struct Sight {
  float growth = 0.0f;         ///< of the position's variance, m²/s (sighted_growth)
  float equal_dark_s = 0.0f;   ///< equal_dark_time(growth)
  float translation_m = 0.0f;  ///< FrameSigma::translation_m
  float rotation_rad = 0.0f;   ///< FrameSigma::rotation_rad
};

/// Sight by place and heading. The rays of a view are summed. They meet the ground as far as the grazing angle allows,
/// and the upright sides of regions and obstacles. Obstacles hide all that is behind them. The camera is level.
///
/// Places lie on a grid; queries take the nearest one. Building takes about 25 µs per place, of which there are at
/// most kMaxPlaces. Deterministic on one machine; atan2 and pow of another libm may differ in the last bit.
class InformationMap {
 public:
  static constexpr int kRays = 24;              ///< directions per turn: rays, and headings
  static constexpr double kMaxPlaces = 4000.0;  ///< the spacing is enlarged so that there are at most as many
  static constexpr double kSpacing = 1.0;       ///< least spacing of places, horizontally, m

  /// @param domain   the places, W; not empty. Queries outside of it take the nearest place.
  /// @param heights  of the layers of places, W; not empty, ascending
  InformationMap(const SurfaceMap& surfaces, const Box& domain, std::vector<double> heights,
                 const TextureCamera& camera = {});

  /// Returns the sight of a camera at p that looks along this horizontal direction. A direction of length 0 takes the
  /// best heading.
  [[nodiscard]] const Sight& sight(const Vec3& p, double direction_x, double direction_y) const;
  /// The same with the heading as a number of kRays, −kRays or more.
  [[nodiscard]] const Sight& sight(const Vec3& p, int heading) const { return sights_[sight_at(p, heading)]; }
  /// Returns the heading nearest to this horizontal direction, or kBest for one of length 0.
  [[nodiscard]] static int heading_of(double direction_x, double direction_y);
  static constexpr int kBest = -1000;  ///< of the headings at a place, the one of least growth
  /// Returns the growth without any landmark in view, m²/s.
  [[nodiscard]] double blind_growth() const { return blind_growth_; }
  /// Returns the camera's horizontal field of view, rad.
  [[nodiscard]] double view_rad() const { return camera_.view_rad; }
  [[nodiscard]] double frame_s() const { return camera_.frame_s; }

 private:
  [[nodiscard]] std::size_t place_of(const Vec3& p) const {
    const auto nearest = [this](double at, double from, int n) {
      return static_cast<std::size_t>(std::clamp((at - from) * inverse_step_, 0.0, n - 0.5));
    };
    std::size_t layer = 0;
    while (layer + 1 < heights_.size() && p.z() > 0.5 * (heights_[layer] + heights_[layer + 1])) ++layer;
    return nearest(p.x(), x_edge_, nx_) + idx(nx_) * (nearest(p.y(), y_edge_, ny_) + idx(ny_) * layer);
  }
  [[nodiscard]] std::size_t sight_at(const Vec3& p, int heading) const {
    const std::size_t place = place_of(p);
    if (heading == kBest) heading = best_[place];
    return place * kRays + idx((heading + kRays) % kRays);
  }
  void look_around(const SurfaceMap& surfaces, const Vec3& eye);

  TextureCamera camera_;
  double blind_growth_ = 0.0;
  double x_edge_ = 0.0, y_edge_ = 0.0;  ///< half a step before the first place
  double x0_ = 0.0, y0_ = 0.0, step_ = kSpacing, inverse_step_ = 1.0;
  int nx_ = 1, ny_ = 1;
  std::vector<double> heights_;
  std::vector<Sight> sights_;       ///< kRays per place
  std::vector<std::uint8_t> best_;  ///< per place: the heading of least growth
};

/// Returns what a ray in this horizontal direction (unit) sees. Of a turn it represents `width` radians.
ViewInformation look_along(const SurfaceMap& surfaces, const Vec3& eye, const Eigen::Vector2d& direction, double width,
                           const TextureCamera& camera);

}  // namespace tern
