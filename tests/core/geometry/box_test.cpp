#include "core/geometry/box.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

TEST(Box, CornersAreAllCombinationsOfItsLimits) {
  const Eigen::Matrix<double, 3, 8> corners = box_corners(Box(Vec3(-1.0, 2.0, 3.0), Vec3(4.0, 5.0, 7.0)));
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(corners(0, k), (k & 1) != 0 ? 4.0 : -1.0);
    EXPECT_EQ(corners(1, k), (k & 2) != 0 ? 5.0 : 2.0);
    EXPECT_EQ(corners(2, k), (k & 4) != 0 ? 7.0 : 3.0);
  }
}

}  // namespace
}  // namespace tern
