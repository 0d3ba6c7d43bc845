// The filters of the resting hypothesis of one track, one per axis.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/world/observation.h"
#include "predictor/models/axis_filter.h"
#include "predictor/tracking/matching.h"

namespace tern {

/// @param speed_variance  of each axis, m²/s²
inline std::array<AxisFilter, 3> start_filters(const Detection& detection, double speed_variance) {
  std::array<AxisFilter, 3> axes;
  for (int i = 0; i < 3; ++i) {
    axes[static_cast<std::size_t>(i)] = {detection.position[i], 0.0, std::max(detection.variance[i], kMinVariance), 0.0,
                                         speed_variance};
  }
  return axes;
}

inline void update_axes(std::array<AxisFilter, 3>& axes, const Detection& detection) {
  for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)].update(detection.position[i], detection.variance[i]);
}

inline Vec3 position(const std::array<AxisFilter, 3>& axes) { return {axes[0].x, axes[1].x, axes[2].x}; }

inline Fit fit_of(const std::array<AxisFilter, 3>& axes, const Detection& detection) {
  return fit(position(axes), Vec3(axes[0].xx, axes[1].xx, axes[2].xx), detection.position, detection.variance);
}

inline bool is_seen_at(const std::array<AxisFilter, 3>& place, const ObservationSet& set) {
  return std::ranges::any_of(set.detections,
                             [&](const Detection& d) { return fit_of(place, d).distance2 <= kAssociationGate; });
}

}  // namespace tern
