// After its first pictures a detector allocates nothing. In this executable malloc counts its calls.
#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "perception/detector.h"
#include "tests/perception/scene.h"
#include "tests/support/allocation_counter.h"

namespace tern {
namespace {

TEST(DetectorAllocation, IsNoneAfterTheFirstPicture) {
  Rng rng(3);
  std::vector<Box> boxes;
  for (int k = 0; k < 60; ++k) {
    boxes.push_back(box_around(Vec3(rng.uniform(2, 9), rng.uniform(-8, 8), rng.uniform(0, 3)), Vec3(0.3, 0.4, 0.4)));
  }
  for (const DepthSensor& sensor : {support::camera(), support::lidar()}) {
    support::Scene scene(sensor);
    scene.render(looking(Vec3(0, 0, 1), 0.0), boxes, 0.0);
    Detector detector;
    const std::size_t found = detector.detect(scene.picture, {0.0, {boxes.data(), 5}}).size();
    EXPECT_GT(found, 10u);
    const long before = support::allocations_so_far();
    const std::size_t again = detector.detect(scene.picture, {0.0, {boxes.data(), 5}}).size();
    EXPECT_EQ(support::allocations_so_far() - before, 0);
    EXPECT_EQ(again, found);
  }
}

}  // namespace
}  // namespace tern
