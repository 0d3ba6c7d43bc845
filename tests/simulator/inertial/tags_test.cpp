#include "simulator/inertial/tags.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tern {
namespace {

const Vec3 kBody(0.0, 0.0, 1.0);

/// At kBody, looking along W's x axis, at rest.
CameraFrame ahead(const std::vector<Box>& boxes = {}) {
  InertialState body;
  body.p = kBody;
  return {StereoSpec{}, body, Vec3::Zero(), boxes};
}

std::size_t seen(const VisualTag& tag, const CameraFrame& frame) {
  return TagSight({tag}, 1).look(frame, kBody, UTime{7}).size();
}

TEST(TagSight, SeesWhatIsInViewInRangeAndNotHidden) {
  VisualTag tag;
  tag.position = Vec3(6.0, 1.0, 1.0);
  EXPECT_EQ(seen(tag, ahead()), 1U);
  EXPECT_EQ(seen(tag, ahead({box_around(Vec3(3.0, 0.5, 1.0), Vec3::Constant(0.3))})), 0U);
  EXPECT_EQ(seen(tag, ahead({box_around(Vec3(9.0, 1.5, 1.0), Vec3::Constant(0.3))})), 1U) << "a box behind the tag";
  tag.range_m = 6.0;
  EXPECT_EQ(seen(tag, ahead()), 0U) << "6.1 m away";
  tag.range_m = 100.0;
  tag.position = Vec3(-6.0, 1.0, 1.0);
  EXPECT_EQ(seen(tag, ahead()), 0U) << "behind the vehicle";
}

/// χ² of 3 n squared errors: mean 3 n, standard deviation √(6 n).
TEST(TagSight, ErrorsAreAsStated) {
  VisualTag near, far;
  near.position = Vec3(2.0, 0.0, 1.0);
  far.position = Vec3(7.0, -1.0, 1.5);
  TagSight sight({near, far}, 5);
  constexpr int kLooks = 4000;
  double squares = 0.0;
  for (int k = 0; k < kLooks; ++k) {
    const auto fixes = sight.look(ahead(), kBody, UTime{k});
    ASSERT_EQ(fixes.size(), 2U);
    EXPECT_EQ(fixes[0].sensor_id, 0);
    EXPECT_EQ(fixes[1].sensor_id, 1);
    EXPECT_EQ(fixes[1].at, UTime{k});
    EXPECT_NEAR(std::sqrt(fixes[0].variance.x()), 0.02 + 0.01 * 2.0, 1e-12);
    EXPECT_GT(fixes[1].variance.x(), fixes[0].variance.x());
    for (const PositionFix& fix : fixes)
      squares += (fix.position - kBody).cwiseAbs2().cwiseQuotient(fix.variance).sum();
  }
  constexpr double kCount = 3.0 * 2 * kLooks;
  EXPECT_NEAR(squares, kCount, 4.0 * std::sqrt(2.0 * kCount));
}

}  // namespace
}  // namespace tern
