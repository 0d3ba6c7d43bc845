// The corners of axis-aligned boxes.
#pragma once

#include "core/base/types.h"

namespace tern {

/// Returns the eight corners of a box, in W, m. Bits 0, 1, 2 of the corner's index k select the maximum (1) or the
/// minimum (0) in x, y, z.
/// @pre the box is not empty; the corners of an empty box are meaningless
inline Eigen::Matrix<double, 3, 8> box_corners(const Box& box) {
  Eigen::Matrix<double, 3, 8> corners;
  for (int k = 0; k < 8; ++k) {
    corners.col(k) << ((k & 1) != 0 ? box.max() : box.min()).x(), ((k & 2) != 0 ? box.max() : box.min()).y(),
        ((k & 4) != 0 ? box.max() : box.min()).z();
  }
  return corners;
}

}  // namespace tern
