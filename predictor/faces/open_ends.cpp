#include "predictor/faces/open_ends.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "perception/view.h"

namespace tern {
namespace {

// The section of a box across an axis: the place of its middle, and how far its corners lie from that.
struct Section {
  Vec3 middle = Vec3::Zero(), corner = Vec3::Zero();
  bool is_wide = false;
};

Section section_of(const Box& box, int axis, double error) {
  Section section{box.center(), (0.5 * box.sizes() - Vec3::Constant(error)).cwiseMax(0.0), false};
  section.corner[axis] = 0.0;
  section.is_wide = section.corner.maxCoeff() > 0.5 * kWideSection;
  return section;
}

bool is_seen_through(const SensorView& view, const Section& section, const Vec3& middle, int axis) {
  if (looked_at(view, middle) == Looked::Through) return true;
  if (!section.is_wide) return false;
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (const auto& [sign_b, sign_c] : std::array<std::array<double, 2>, 4>{{{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}}) {
    Vec3 p = middle;
    p[b] += sign_b * section.corner[b];
    p[c] += sign_c * section.corner[c];
    if (looked_at(view, p) == Looked::Through) return true;
  }
  return false;
}

// How far beyond the face the sensor is, m; `farthest` if it is not surely ahead of the face.
double to_sensor(const SensorView& view, const Box& box, int axis, int side, double farthest, double error) {
  for (int other = 0; other < 3; ++other) {
    const double at = view.sensor_position[other];
    const bool is_ahead = at > box.min()[other] + error && at < box.max()[other] - error;
    if (other != axis && !is_ahead) return farthest;
  }
  const double beyond =
      side < 0 ? box.min()[axis] - view.sensor_position[axis] : view.sensor_position[axis] - box.max()[axis];
  return beyond > 0.0 ? std::min(farthest, beyond + error) : farthest;
}

}  // namespace

double seen_empty_beyond(const SensorView& view, const Box& box, int axis, int side, double farthest, double error) {
  const double most = to_sensor(view, box, axis, side, farthest, error);
  if (view.depths.empty()) return most;
  const Section section = section_of(box, axis, error);
  double empty_from = most;
  bool was_empty = false;
  const int steps = static_cast<int>(std::ceil(most / kEndStep));
  for (int step = 1; step <= steps; ++step) {
    const double beyond = step * kEndStep;
    Vec3 middle = section.middle;
    middle[axis] = side < 0 ? box.min()[axis] - beyond : box.max()[axis] + beyond;
    const bool is_empty = is_seen_through(view, section, middle, axis);
    if (is_empty && was_empty) return std::min(most, empty_from + error);
    if (is_empty) empty_from = beyond;
    was_empty = is_empty;
  }
  return most;
}

}  // namespace tern
