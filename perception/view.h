// The space that a sensor looked at, as a coarse depth picture: it tells "not seen" from "seen to be empty".
#pragma once

#include <cstdint>

#include "core/base/types.h"
#include "core/world/sighting.h"
#include "perception/depth_picture.h"

namespace tern {

/// Returns the view of a picture, in the smallest square cells of pixels of which at most kMaxViewCells are needed.
/// Columns and rows beyond the last whole cell are left out, so they count as out of view.
SensorView view_of(const DepthPicture& picture);

/// How a point of W was looked at.
enum class Looked : std::uint8_t {
  OutOfView,  ///< outside the field of view or the range, or in a blind cell
  Blocked,    ///< something nearer, or at the point itself, was measured in its cell
  /// The whole cell measured more than 3σ + kThroughMargin farther. Nothing is there, or it fits between two rays.
  Through,
};
inline constexpr double kThroughMargin = 0.15;  ///< m; a step between two pixels on a slanted surface at 10 m

/// Returns how p_W (m) was looked at. O(1). @pre rows × columns depths
Looked looked_at(const SensorView& view, const Vec3& p_W);

/// The cell of a point, and its depth as of the view's kind, m. cell −1: outside the field of view.
struct ViewPlace {
  int cell = -1;  ///< row · columns + column
  double depth = 0.0;
};
ViewPlace place_in(const SensorView& view, const Vec3& p_W);

/// Returns the depth of a cell: 0 if it is blind, infinity if nothing was within the range, m.
double cell_depth(const SensorView& view, int cell);

}  // namespace tern
