#include "core/world/stated_bound.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace tern {
namespace {

std::array<double, 36> pose_covariance(const Eigen::Matrix3d& position) {
  std::array<double, 36> all{};
  for (int k = 0; k < 9; ++k) all[idx(6 * (k / 3) + k % 3)] = position(k / 3, k % 3);
  return all;
}

TEST(StatedBound, IsTheLongestHalfAxisOfTheEllipsoid) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d covariance = turn * Vec3(0.01, 0.25, 0.04).asDiagonal() * turn.transpose();
  EXPECT_NEAR(stated_bound(pose_covariance(covariance)), std::sqrt(11.345) * 0.5, 1e-9);
  EXPECT_TRUE(position_covariance(pose_covariance(covariance)).isApprox(covariance));
}

TEST(StatedBound, OfAPerfectEstimateIsZero) { EXPECT_EQ(stated_bound(pose_covariance(Eigen::Matrix3d::Zero())), 0.0); }

}  // namespace
}  // namespace tern
