// The space that a sensor looked at, as a coarse depth picture: it tells "not seen" from "seen to be empty".
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "perception/depth_picture.h"

namespace tern {

/// The smallest depth that was measured in each cell of a picture: every pixel of the cell measured at least this deep.
struct CoarseView {
  PictureShape shape;  ///< of the picture
  int cell = 2;        ///< pixels per cell and direction, ≥ 1
  SensorPose pose;
  double least_range_m = 0.2;
  double range_m = 10.0;
  DepthNoise noise;
  /// By row·columns() + column, m. kNotMeasured: a pixel measured nothing; range_m: no return in the whole cell.
  std::vector<float> depths;

  [[nodiscard]] int columns() const { return (shape.columns + cell - 1) / cell; }
  [[nodiscard]] int rows() const { return (shape.rows + cell - 1) / cell; }
};

/// Returns the coarse view of a picture. @throws std::invalid_argument for a cell below 1
CoarseView coarse_view(const DepthPicture& picture, int cell);

/// How a point of W was looked at.
enum class Looked : std::uint8_t {
  OutOfView,  ///< outside the field of view or the range, or nothing was measured there
  Blocked,    ///< something nearer, or at the point itself, was measured in its direction
  Through,    ///< the whole cell measured more than 3σ + kThroughMargin farther: the point is empty
};
inline constexpr double kThroughMargin = 0.15;  ///< m; half the depth of a pixel's step on a slanted surface at 10 m

/// Returns how p_W (m) was looked at. O(1).
Looked looked_at(const CoarseView& view, const Vec3& p_W);

}  // namespace tern
