// tern-mapper with uploaded fences: FENCES in, versions of the map out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/world/uploaded_fences.h"
#include "runtime/virtual_runner.h"
#include "semantic_mapper/app/mapper_node.h"
#include "tests/support/effort.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

using ::testing::HasSubstr;

/// A mapper over 40 × 40 × 8 voxels of 0.25 m, whose flight box is the map, and a test that receives its maps.
class FenceUploadsTest : public ::testing::Test {
 protected:
  FenceUploadsTest() {
    base_ = support::free_map({40, 40, 8});
    support::paint(base_, {0, 0, 0}, {39, 39, 0}, VoxelLabel::Occupied);
    runner_.observer().subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) {
      ++chunks_;
      const auto done = assembler_.add(chunk);
      ASSERT_TRUE(done) << done.error().message;
      if (*done) maps_.push_back(assembler_.take());
    });
  }
  void start(const std::optional<LiveSetup>& live = {}) {
    node_ = &runner_.start("tern-mapper", [&](Bus& bus) {
      return std::make_unique<MapperNode>(bus, base_, live, Box(Vec3::Zero(), Vec3(10, 10, 2)));
    });
  }
  void run(double seconds) { runner_.run(runner_.now() + Duration::from_seconds(seconds)); }
  void publish(std::vector<Fence> fences) {
    runner_.observer().publish(channels::kFences, FenceSet{{}, std::move(fences)});
  }
  [[nodiscard]] VoxelLabel label_at(const Vec3& p) const {
    const VoxelMap& map = maps_.back();
    return map.labels[idx(map.grid.index(map.grid.cell_of(p)))];
  }
  static Fence circle(double x, double y, double radius, bool is_inclusion = false) {
    Fence fence;
    fence.is_inclusion = is_inclusion;
    fence.shape = FenceCircle{{x, y}, radius};
    return fence;
  }
  static Fence polygon(std::vector<Eigen::Vector2d> corners) {
    Fence fence;
    fence.shape = FencePolygon{std::move(corners)};
    return fence;
  }

  VirtualRunner runner_;
  VoxelMap base_;
  const Node* node_ = nullptr;
  MapAssembler assembler_;
  std::vector<VoxelMap> maps_;
  int chunks_ = 0;
};

TEST_F(FenceUploadsTest, NoMapIsPublishedBeforeFencesAreHeard) {
  start();
  run(3.0);
  EXPECT_EQ(chunks_, 0) << "receivers keep the map of the process before, with its fences";
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_THAT(node_->health().waiting_for, HasSubstr("FENCES of tern-mission"));
  publish({});
  run(1.0);
  ASSERT_EQ(maps_.size(), 1u);
  EXPECT_EQ(maps_[0].version, base_.version);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
}

TEST_F(FenceUploadsTest, FencesAreInTheMapWithinASecondAndGoAgain) {
  start();
  publish({});
  run(1.5);
  publish({circle(5, 5, 1)});
  run(1.0);
  ASSERT_EQ(maps_.size(), 2u);
  EXPECT_EQ(label_at({5, 5, 1}), VoxelLabel::Occupied);
  EXPECT_EQ(label_at({8, 5, 1}), VoxelLabel::Free);
  publish({circle(5, 5, 1)});
  run(3.0);
  EXPECT_EQ(maps_.size(), 2u) << "repeated ones are no new version";
  publish({circle(5, 5, 4, true)});
  run(1.0);
  ASSERT_EQ(maps_.size(), 3u);
  EXPECT_EQ(label_at({5, 5, 1}), VoxelLabel::Free);
  EXPECT_EQ(label_at({9.5, 5, 1}), VoxelLabel::Occupied);
  publish({});
  run(1.0);
  EXPECT_EQ(maps_.back().version, base_.version);
}

TEST_F(FenceUploadsTest, RefusedFencesLeaveThoseBeforeInForce) {
  start();
  publish({circle(5, 5, 1)});
  run(1.0);
  publish({polygon({{1, 1}, {2, 2}, {2, 1}, {1, 2}})});
  run(1.5);
  EXPECT_EQ(maps_.size(), 1u);
  EXPECT_EQ(label_at({5, 5, 1}), VoxelLabel::Occupied);
  EXPECT_THAT(node_->health().waiting_for,
              HasSubstr("uploaded fences are not used: a polygon touches or crosses itself"));
  publish({circle(5, 5, 1)});
  run(0.5);
  EXPECT_EQ(node_->health().waiting_for, "");
}

TEST_F(FenceUploadsTest, WithoutAnyFencesThatItTakesNoMapIsPublished) {
  start();
  publish({polygon({{1, 1}, {2, 2}, {2, 1}, {1, 2}})});
  run(2.0);
  EXPECT_EQ(chunks_, 0);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
}

TEST_F(FenceUploadsTest, ScansOfALiveMapFreeNoFence) {
  LiveSetup setup;
  setup.period = Duration{500'000};
  setup.body.vertices = Points::Zero(3, 1);
  setup.body.radius = 0.3;
  setup.position = Vec3(1, 5, 1);
  start(setup);
  publish({circle(5, 5, 0.5)});
  for (int k = 0; k < 20; ++k) {
    CloudScan scan;
    scan.at = runner_.now();
    scan.sensor_position = Vec3(1, 5, 1);
    for (double y = 3.0; y < 7.0; y += 0.1) scan.points.push_back({Vec3(8.1, y - 5.0, 0).cast<float>(), 0});
    runner_.observer().publish(channels::kPointCloud, scan);
    run(0.2);
  }
  ASSERT_FALSE(maps_.empty());
  EXPECT_EQ(label_at({5, 5, 1}), VoxelLabel::Occupied) << "rays have passed it";
  EXPECT_EQ(label_at({9.1, 5, 1}), VoxelLabel::Occupied) << "what was hit";
  publish({});
  run(1.5);
  EXPECT_EQ(label_at({5, 5, 1}), VoxelLabel::Free);
}

/// Whatever comes, the mapper publishes a map only with the newest fences that it took.
TEST_F(FenceUploadsTest, AnyFencesAreHeldOrRefused) {
  start();
  Rng rng(7);
  const auto place = [&] { return Eigen::Vector2d(rng.uniform(-5, 15), rng.uniform(-5, 15)); };
  std::vector<VoxelLabel> held;
  const int rounds = support::at_effort(3'000);
  for (int k = 0; k < rounds && !HasFailure(); ++k) {
    std::vector<Fence> fences;
    for (int n = static_cast<int>(rng.uniform(0, 4)); n > 0; --n) {
      if (rng.uniform() < 0.5) {
        fences.push_back(circle(place().x(), place().y(), rng.uniform(0.01, 8.0), rng.uniform() < 0.5));
      } else {
        std::vector<Eigen::Vector2d> corners(3 + static_cast<std::size_t>(rng.uniform(0, 3)));
        for (Eigen::Vector2d& corner : corners) corner = place();
        fences.push_back(polygon(corners));
      }
    }
    publish(fences);
    run(1.2);
    const bool is_taken = node_->health().waiting_for.empty();
    if (is_taken) held = uploaded_fence_labels(fences, base_.grid, Box(Vec3::Zero(), Vec3(10, 10, 2))).value();
    if (!maps_.empty()) {
      ASSERT_TRUE(holds_fences(maps_.back(), held)) << k;
    }
  }
  EXPECT_GT(std::ssize(maps_), rounds / 4);
}

}  // namespace
}  // namespace tern
