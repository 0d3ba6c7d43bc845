#include "planner/unseen/sight_fan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tern {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The picture's row that contains the horizontal plane; −1 if none does. Rows are from the top.
int level_row(const SensorView& view) {
  if (view.up <= 0.0 || view.down <= 0.0) return -1;
  const bool pinhole = view.kind == ViewKind::Pinhole;
  const double up = pinhole ? std::tan(view.up) : view.up, down = pinhole ? std::tan(view.down) : view.down;
  return std::clamp(static_cast<int>(up / (up + down) * view.rows), 0, view.rows - 1);
}

/// The range along the ray that is free in a cell, m.
double free_range(const SensorView& view, std::int16_t cell, double azimuth) {
  if (cell == kBlindDepth) return 0.0;
  double depth = cell == kFarDepth ? view.range_m : std::min(view.range_m, cell * view.unit_m);
  depth -= 3.0 * (view.depth_sigma + view.depth_sigma_per_square_m * depth * depth);
  // The depth of a pinhole is along its axis: the ray is at least as long everywhere in the cell.
  return std::max(0.0, view.kind == ViewKind::Pinhole ? depth / std::cos(azimuth) : depth);
}

}  // namespace

bool SightFan::sees_empty(const Eigen::Vector2d& centre, double radius) const {
  const Eigen::Vector2d to = centre - eye;
  const double distance = to.norm();
  if (reach.empty() || distance - radius < nearest || distance <= radius) return false;
  const double half = std::asin(radius / distance);
  const double turn = std::atan2(to.y(), to.x()) - half - first;
  const double from = (turn - kTurn * std::floor(turn / kTurn)) / width, until = from + 2.0 * half / width;
  const auto sectors = static_cast<double>(reach.size());
  const bool closed = sectors * width >= kTurn - 1e-9;
  if (!closed && until > sectors) return false;
  for (auto k = static_cast<std::size_t>(from); static_cast<double>(k) <= until; ++k) {
    if (!closed && k >= reach.size()) return false;
    if (reach[k % reach.size()] < distance + radius) return false;
  }
  return true;
}

SightFan level_fan(const SensorView& view) {
  SightFan fan;
  const Eigen::Quaterniond q_WC(view.q_WC[0], view.q_WC[1], view.q_WC[2], view.q_WC[3]);
  const Vec3 down = q_WC * Vec3::UnitY(), ahead = q_WC * Vec3::UnitZ();
  const int row = view.rows > 0 && view.columns > 0 ? level_row(view) : -1;
  if (row < 0 || -down.z() < std::cos(kLevel)) return fan;
  const double azimuth = std::atan2(ahead.y(), ahead.x());
  const bool pinhole = view.kind == ViewKind::Pinhole;
  const double left = pinhole ? std::tan(view.left) : view.left, right = pinhole ? std::tan(view.right) : view.right;
  const int sectors = view.columns * kSectorsPerColumn;
  fan.eye = view.sensor_position.head<2>();
  fan.first = azimuth - view.right;  // azimuths of C grow to the right, those of W to the left
  fan.width = (view.left + view.right) / sectors;
  fan.nearest = view.near_m / (pinhole ? std::cos(std::max(view.left, view.right)) : 1.0);
  const auto column_of = [&](double to_the_right) {
    const double x = pinhole ? std::tan(to_the_right) : to_the_right;
    return std::clamp(static_cast<int>(std::floor((x + left) / (left + right) * view.columns)), 0, view.columns - 1);
  };
  for (int k = 0; k < sectors; ++k) {
    const double high = view.right - k * fan.width, low = high - fan.width;  // to the right of the axis
    double reach = view.range_m;
    for (int c = column_of(low + 1e-12); c <= column_of(high - 1e-12); ++c) {
      const std::int16_t cell = view.depths[idx(row * view.columns + c)];
      const double nearer = low * high <= 0.0 ? 0.0 : std::min(std::abs(low), std::abs(high));
      reach = std::min(reach, free_range(view, cell, nearer));
    }
    fan.reach.push_back(reach);
  }
  return fan;
}

}  // namespace tern
