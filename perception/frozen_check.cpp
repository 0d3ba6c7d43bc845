#include "perception/frozen_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tern {
namespace {

/// Stands for `without limit`, m: no depth sensor measures as far.
constexpr double kFarthest = 500.0;
constexpr std::int16_t kFarMarker = std::numeric_limits<std::int16_t>::max();
/// Depths that differ by a smaller share are the same: a cloud that is turned is rounded. A unit of 32767 is 3e-5.
constexpr float kRounding = 1e-5F;

/// The angle between two orientations, rad. @param a, b  unit quaternions
double angle_between(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return 2.0 * std::acos(std::min(1.0, std::abs(a.dot(b))));
}

bool are_same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float x, float y) { return std::abs(x - y) <= kRounding * std::max(x, y); });
}

}  // namespace

void MeasuredDepths::add(const DepthImage& part) {
  position = part.sensor_position;
  q_WC = part.q_WC;
  const double range = part.range_m > 0.0 ? part.range_m : kFarthest;
  for (const std::int16_t units : part.depths) {
    if (depths.size() == kMost) return;
    const double depth = std::max<std::int16_t>(units, 0) * part.unit_m;
    if (units > 0 && units < kFarMarker && depth < range) ++surfaces;
    depths.push_back(static_cast<float>(depth));
  }
}

void MeasuredDepths::add(const CloudScan& part) {
  position = part.sensor_position;
  const double range = part.range_m > 0.0 ? part.range_m : kFarthest;
  for (const CloudPoint& point : part.points) {
    if (depths.size() == kMost) return;
    const float distance = point.position.allFinite() ? point.position.norm() : 0.0F;
    if (distance > 0.0F && distance < range) ++surfaces;
    depths.push_back(distance);
  }
}

bool FrozenCheck::is_frozen(std::int32_t sensor, MeasuredDepths now) {
  if (!seen_.contains(sensor) && seen_.size() == kMostSensors) {
    seen_.erase(std::ranges::min_element(seen_, {}, [](const auto& entry) { return entry.second.number; }));
  }
  Seen& seen = seen_[sensor];
  seen.number = ++number_;
  if (now.surfaces < kLeastSurfaces || !are_same(seen.measured.depths, now.depths)) {
    seen.measured = std::move(now);
    return false;
  }
  return (now.position - seen.measured.position).norm() > kMoved ||
         angle_between(now.q_WC, seen.measured.q_WC) > kTurned;
}

}  // namespace tern
