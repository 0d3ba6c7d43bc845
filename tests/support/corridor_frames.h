// Frames of a lidar in a corridor with a gap, for tests of unseen movers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/world/sighting.h"

namespace tern::support {

using Vec2 = Eigen::Vector2d;
using Square = Eigen::AlignedBox2d;

/// The level frame of a lidar at p, with the range that each column measures.
template <class Range>
SightingSet frame_at(UTime at, std::int32_t sensor, const Vec2& p, const Range& range) {
  SightingSet frame;
  frame.at = at;
  frame.sensor_id = sensor;
  SensorView& view = frame.view;
  view.kind = ViewKind::Spherical;
  view.sensor_position = Vec3(p.x(), p.y(), 1.0);
  Eigen::Matrix3d level;  // columns: right, down and forward of a sensor that looks along x
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Quaterniond q(level);
  view.q_WC = {q.w(), q.x(), q.y(), q.z()};
  view.left = view.right = std::numbers::pi;
  view.up = view.down = 0.3;
  view.range_m = 10.0;
  view.rows = 2;
  view.columns = 180;
  for (int row = 0; row < view.rows; ++row) {
    for (int k = 0; k < view.columns; ++k) {
      const double first = std::numbers::pi - k * 2.0 * std::numbers::pi / view.columns;
      double least = view.range_m;
      for (int part = 0; part <= 4; ++part) {
        least = std::min(least, range(first - part * 0.5 * std::numbers::pi / view.columns));
      }
      view.depths.push_back(least >= view.range_m ? kFarDepth : static_cast<std::int16_t>(least / view.unit_m));
    }
  }
  return frame;
}

/// A corridor whose left wall has a gap, and people behind that wall.
struct Corridor {
  double wall, gap;  ///< distance of the walls from the middle; start of the gap along x, m
  std::array<Square, 3> walls;

  explicit Corridor(Rng& rng) : wall(rng.uniform(1.0, 2.5)), gap(rng.uniform(2.0, 5.0)) {
    walls = {Square(Vec2(-20, wall), Vec2(gap, wall + 0.2)), Square(Vec2(gap + 1.5, wall), Vec2(20, wall + 0.2)),
             Square(Vec2(-20, -wall - 0.2), Vec2(20, -wall))};
  }
  [[nodiscard]] double range(const Vec2& eye, double azimuth) const {
    const Vec2 ray(std::cos(azimuth), std::sin(azimuth));
    double range = 10.0;
    for (const Square& box : walls) {
      double in = 0.0, out = 10.0;
      for (int axis = 0; axis < 2; ++axis) {
        const double a = (box.min()[axis] - eye[axis]) / ray[axis], b = (box.max()[axis] - eye[axis]) / ray[axis];
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
      }
      if (in <= out) range = std::min(range, in);
    }
    return range;
  }
  [[nodiscard]] bool has_room(const Square& body) const {
    return std::none_of(walls.begin(), walls.end(), [&](const Square& w) { return w.intersects(body); });
  }
};

}  // namespace tern::support
