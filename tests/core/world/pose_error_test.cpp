#include "core/world/pose_error.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/world/pose_error_join.h"

namespace tern {
namespace {

PoseError random_error(Rng& rng) {
  Eigen::Matrix<double, 6, 6> L;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) L(row, column) = (row < 3 ? 0.2 : 0.01) * rng.uniform(-1.0, 1.0);
  }
  const Eigen::Matrix<double, 6, 6> P = L * L.transpose();
  PoseError error;
  error.position = Vec3(rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0), rng.uniform(0.0, 5.0));
  for (int k = 0; k < 36; ++k) error.pose_covariance[idx(k)] = P(k / 6, k % 6);
  error.apart = rng.uniform(0.0, 0.3);
  return error;
}

TEST(PoseError, TheMarginOfABoxIsThatOfItsWorstPoint) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Rng rng(seed);
    const PoseError error = random_error(rng);
    const auto near = [&]() -> Vec3 { return error.position + Vec3(rng.normal(), rng.normal(), rng.normal()) * 8.0; };
    Box box(near());
    box.extend(near());
    double worst = 0.0;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 share(rng.uniform(), rng.uniform(), rng.uniform());
      worst = std::max(worst, error.margin(Vec3(box.min() + share.cwiseProduct(box.sizes()))));
    }
    const double margin = error.margin(box);
    ASSERT_GE(margin, worst) << "seed " << seed;
    ASSERT_LE(margin, worst + 0.3) << "seed " << seed;  // the samples miss the corners by a little
  }
}

PoseError error_of(std::int64_t epoch_us, std::int64_t set, double apart = 0.1) {
  PoseError error;
  error.header.name = {epoch_us, set};
  error.set = set;
  error.apart = apart;
  return error;
}

TrackSet set_of(std::int64_t epoch_us, std::int64_t number) {
  TrackSet set;
  set.header.name = {epoch_us, number};
  set.batch.set = number;
  return set;
}

TEST(PoseErrorJoin, ASetHasTheErrorOfItsOwnNumberAndSender) {
  PoseErrorJoin join;
  join.add(error_of(7, 3, 0.3));
  join.add(error_of(8, 4, 0.4));
  join.add(error_of(7, 4, 0.5));
  TrackSet set = set_of(7, 4);
  ASSERT_TRUE(join.add_to(set));
  ASSERT_TRUE(set.pose_error);
  EXPECT_EQ(set.pose_error->apart, 0.5);
}

TEST(PoseErrorJoin, ASenderWithoutErrorsHasExactPoses) {
  PoseErrorJoin join;
  join.add(error_of(8, 1));
  TrackSet set = set_of(7, 4);
  EXPECT_TRUE(join.add_to(set));
  EXPECT_FALSE(set.pose_error);
}

TEST(PoseErrorJoin, ASetWhoseErrorWasLostIsNotToBeUsed) {
  PoseErrorJoin join;
  join.add(error_of(7, 3));
  TrackSet before = set_of(7, 2), lost = set_of(7, 4);
  EXPECT_TRUE(join.add_to(before));  // of the time before the first ODOMETRY
  EXPECT_FALSE(join.add_to(lost));
  join.add(error_of(7, 5));
  TrackSet next = set_of(7, 5);
  EXPECT_TRUE(join.add_to(next));
}

}  // namespace
}  // namespace tern
