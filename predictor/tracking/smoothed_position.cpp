#include "predictor/tracking/smoothed_position.h"

#include <Eigen/LU>
#include <algorithm>
#include <cstddef>

namespace tern {
namespace {

constexpr std::size_t kMinOfParabola = 4;  // detections
// Detections of several sensors at nearly the same time are of one instant. Two instants determine no parabola.
constexpr int kMinInstants = 3;
constexpr Duration kOneInstant{20'000};

// Time in units of the span: 1, t, t².
Eigen::Vector3d powers(const Measurement& detection, UTime at) {
  const double t = (detection.at - at).seconds() / kSmoothingSpan;
  return {1.0, t, t * t};
}

std::optional<Measurement> interpolated(const std::vector<Measurement>& detections, UTime at) {
  const auto after = std::ranges::find_if(detections, [&](const Measurement& s) { return s.at >= at; });
  if (after == detections.begin() || after == detections.end()) return std::nullopt;
  const Measurement& before = *(after - 1);
  const double gap = (after->at - before.at).seconds();
  if (gap > kMaxGap) return std::nullopt;
  const double u = (at - before.at).seconds() / gap;
  return Measurement{at, (1.0 - u) * before.z + u * after->z, (1.0 - u) * (1.0 - u) * before.r + u * u * after->r};
}

}  // namespace

std::optional<Measurement> smoothed_position(const std::vector<Measurement>& detections, UTime at) {
  std::size_t first = 0;
  while (first < detections.size() && (at - detections[first].at).seconds() > kSmoothingSpan) ++first;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  std::size_t last = first, before = 0;
  int instants = 0;
  UTime instant;
  for (; last < detections.size() && (detections[last].at - at).seconds() <= kSmoothingSpan; ++last) {
    normal += powers(detections[last], at) * powers(detections[last], at).transpose();
    before += detections[last].at <= at ? 1U : 0U;
    if (instants > 0 && detections[last].at - instant < kOneInstant) continue;
    instant = detections[last].at;
    ++instants;
  }
  const bool is_determined = last - first >= kMinOfParabola && instants >= kMinInstants;
  if (!is_determined || before == 0 || before == last - first) return interpolated(detections, at);
  const Eigen::Vector3d solved = normal.inverse().col(0);
  Measurement smoothed{at, Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = first; k < last; ++k) {
    const double c = solved.dot(powers(detections[k], at));
    smoothed.z += c * detections[k].z;
    smoothed.r += c * c * detections[k].r;
  }
  return smoothed;
}

const Measurement& nearest_in_time(const std::vector<Measurement>& detections, UTime at) {
  const auto after = std::lower_bound(detections.begin(), detections.end() - 1, at,
                                      [](const Measurement& s, UTime t) { return s.at < t; });
  return after == detections.begin() || after->at - at < at - (after - 1)->at ? *after : *(after - 1);
}

}  // namespace tern
