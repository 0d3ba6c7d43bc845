// Boxes as point sets.
#pragma once

#include "core/base/types.h"

namespace tern {

/// The eight corners of a box, in W, m. Corner k has the maximum in x, y, z where bit 0, 1, 2 of k is set.
///
/// An empty box (default-constructed) has no corners and gives meaningless ones: ask isEmpty() first.
inline Eigen::Matrix<double, 3, 8> box_corners(const Box& box) {
  Eigen::Matrix<double, 3, 8> corners;
  for (int k = 0; k < 8; ++k) {
    corners.col(k) << ((k & 1) != 0 ? box.max() : box.min()).x(), ((k & 2) != 0 ? box.max() : box.min()).y(),
        ((k & 4) != 0 ? box.max() : box.min()).z();
  }
  return corners;
}

}  // namespace tern
