#include "perception/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tern {
namespace {

constexpr double kUnit = 0.01;  ///< m
/// Depths of longer ranges have a larger unit, so that they stay below kFarDepth.
constexpr double kMostUnits = 32'000.0;

/// The edges of the cells on both sides of the axis, as pixels: from −½ to cells · cell − ½.
void set_fields(SensorView& view, const PictureShape& shape, int cell) {
  view.columns = shape.columns / cell;
  view.rows = shape.rows / cell;
  const double left = (shape.cx + 0.5) / shape.fx, right = (view.columns * cell - 0.5 - shape.cx) / shape.fx;
  const double up = (shape.cy + 0.5) / shape.fy, down = (view.rows * cell - 0.5 - shape.cy) / shape.fy;
  const bool pinhole = shape.kind == PictureKind::Pinhole;
  view.left = pinhole ? std::atan(left) : left;
  view.right = pinhole ? std::atan(right) : right;
  view.up = pinhole ? std::atan(up) : up;
  view.down = pinhole ? std::atan(down) : down;
}

/// Returns the cell of `at` between the edges low and high, or −1.
int between(double at, double low, double high, int count) {
  const double share = (at - low) / (high - low);
  if (!(share >= 0.0 && share <= 1.0)) return -1;
  return std::min(static_cast<int>(share * count), count - 1);
}

}  // namespace

SensorView view_of(const DepthPicture& picture) {
  const DepthSensor& sensor = picture.sensor();
  const PictureShape& shape = sensor.shape;
  const Eigen::Quaterniond& q = picture.pose().q_WC;
  SensorView view;
  view.kind = shape.kind == PictureKind::Pinhole ? ViewKind::Pinhole : ViewKind::Spherical;
  view.sensor_position = picture.pose().position;
  view.q_WC = {q.w(), q.x(), q.y(), q.z()};
  view.near_m = sensor.least_range_m;
  view.range_m = sensor.range_m;
  view.depth_sigma = sensor.noise.constant_m;
  view.depth_sigma_per_square_m = sensor.noise.per_m;
  view.unit_m = std::max(kUnit, sensor.range_m / kMostUnits);
  int cell = 1;
  while ((shape.columns / cell) * (shape.rows / cell) > kMaxViewCells) ++cell;
  set_fields(view, shape, cell);
  view.depths.assign(idx(view.rows * view.columns), kFarDepth);
  for (int v = 0; v < view.rows * cell; ++v) {
    for (int u = 0; u < view.columns * cell; ++u) {
      std::int16_t& least = view.depths[idx(v / cell * view.columns + u / cell)];
      const float depth = picture.depths()[v * shape.columns + u];
      if (depth >= picture.range()) continue;
      least = std::min(least, static_cast<std::int16_t>(depth / view.unit_m));
    }
  }
  return view;
}

ViewPlace place_in(const SensorView& view, const Vec3& p_W) {
  const Eigen::Quaterniond q_WC(view.q_WC[0], view.q_WC[1], view.q_WC[2], view.q_WC[3]);
  const Vec3 p_C = q_WC.conjugate() * (p_W - view.sensor_position);
  int column = -1, row = -1;
  double depth = p_C.z();
  if (view.kind == ViewKind::Pinhole) {
    if (depth <= 0.0) return {};
    column = between(p_C.x() / depth, -std::tan(view.left), std::tan(view.right), view.columns);
    row = between(p_C.y() / depth, -std::tan(view.up), std::tan(view.down), view.rows);
  } else {
    depth = p_C.norm();
    column = between(std::atan2(p_C.x(), p_C.z()), -view.left, view.right, view.columns);
    row = between(std::atan2(p_C.y(), std::hypot(p_C.x(), p_C.z())), -view.up, view.down, view.rows);
  }
  return {column < 0 || row < 0 ? -1 : row * view.columns + column, depth};
}

double cell_depth(const SensorView& view, int cell) {
  const std::int16_t depth = view.depths[idx(cell)];
  return depth == kFarDepth ? std::numeric_limits<double>::infinity() : depth * view.unit_m;
}

Looked looked_at(const SensorView& view, const Vec3& p_W) {
  const ViewPlace place = place_in(view, p_W);
  if (place.cell < 0 || place.depth < view.near_m || place.depth >= view.range_m) return Looked::OutOfView;
  const double measured = std::min(cell_depth(view, place.cell), view.range_m);
  if (measured <= 0.0) return Looked::OutOfView;
  const double sigma = view.depth_sigma + view.depth_sigma_per_square_m * place.depth * place.depth;
  return measured > place.depth + kThroughMargin + 3.0 * sigma ? Looked::Through : Looked::Blocked;
}

}  // namespace tern
