#include "perception/view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tern {

CoarseView coarse_view(const DepthPicture& picture, int cell) {
  if (cell < 1) throw std::invalid_argument("coarse_view: cell " + std::to_string(cell) + " is below 1");
  const DepthSensor& sensor = picture.sensor();
  CoarseView view{sensor.shape, cell, picture.pose(), sensor.least_range_m, sensor.range_m, sensor.noise, {}};
  view.depths.assign(idx(view.columns() * view.rows()), picture.range());
  for (int v = 0, pixel = 0; v < sensor.shape.rows; ++v) {
    for (int u = 0; u < sensor.shape.columns; ++u, ++pixel) {
      float& least = view.depths[idx(v / cell * view.columns() + u / cell)];
      least = std::min(least, picture.depths()[pixel]);
    }
  }
  return view;
}

Looked looked_at(const CoarseView& view, const Vec3& p_W) {
  const auto place = place_in(view.shape, view.pose.q_WC.conjugate() * (p_W - view.pose.position));
  if (!place || place->depth < view.least_range_m || place->depth >= view.range_m) return Looked::OutOfView;
  const int u = std::clamp(static_cast<int>(std::lround(place->u)), 0, view.shape.columns - 1);
  const int v = std::clamp(static_cast<int>(std::lround(place->v)), 0, view.shape.rows - 1);
  const float measured = view.depths[idx(v / view.cell * view.columns() + u / view.cell)];
  if (measured <= kNotMeasured) return Looked::OutOfView;
  const double sigma = view.noise.sigma(static_cast<float>(place->depth));
  return measured > place->depth + kThroughMargin + 3.0 * sigma ? Looked::Through : Looked::Blocked;
}

}  // namespace tern
