#include "simulator/inertial/track_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace tern {
namespace {

const World kEmpty;

/// A wall at x = 8 m, seen from (0, 0, 1).
struct Wall {
  LandmarkSpec spec;
  InertialState body;
  Wall() {
    spec.ground = 0.0;
    body.p = Vec3(0.0, 0.0, 1.0);
  }
  [[nodiscard]] std::vector<Landmark> landmarks() const {
    LandmarkField field(kEmpty, {{"wall", "texture", Box(Vec3(8, -20, -8), Vec3(8.1, 20, 10))}}, spec, 5);
    return field.around(body.p, 25.0, 0.1, 0.0);
  }
  [[nodiscard]] CameraFrame frame(const std::vector<Box>& boxes = {}) const { return {{}, body, Vec3::Zero(), boxes}; }
};

TEST(TrackSimulator, FollowsOneLandmarkPerCellUntilThereAreEnough) {
  const Wall wall;
  TrackSpec spec;
  spec.lost = spec.wrong = spec.noise_px = 0.0;
  TrackSimulator tracker(spec, 1);
  const auto first = tracker.observe(wall.frame(), wall.landmarks());
  ASSERT_EQ(first.size(), 150u);
  std::set<std::pair<int, int>> cells;
  for (const SimulatedTrack& t : first) {
    cells.insert({static_cast<int>(t.left.x() / 40.0), static_cast<int>(t.left.y() / 40.0)});
  }
  EXPECT_EQ(cells.size(), first.size());
  const auto second = tracker.observe(wall.frame(), wall.landmarks());
  ASSERT_EQ(second.size(), 150u);
  for (std::size_t k = 0; k < 150; ++k) {
    EXPECT_EQ(first[k].id, second[k].id);
    EXPECT_EQ(first[k].left, second[k].left);
  }
}

TEST(TrackSimulator, NoiseLossesAndSlipsHaveTheirRates) {
  const Wall wall;
  const auto landmarks = wall.landmarks();
  const CameraFrame frame = wall.frame();
  std::map<std::uint64_t, StereoPixel> exact;
  for (const Landmark& landmark : landmarks) {
    if (const auto pixel = frame.see(landmark.point)) exact[landmark.id] = *pixel;
  }
  TrackSpec spec;
  spec.wrong = 0.01;
  TrackSimulator tracker(spec, 2);
  double offered = 0.0, lost = 0.0, slips = 0.0, n = 0.0, u2 = 0.0, d2 = 0.0;
  std::set<std::int64_t> before, slipped;
  for (int k = 0; k < 400; ++k) {
    std::set<std::int64_t> now;
    for (const SimulatedTrack& t : tracker.observe(frame, landmarks)) {
      now.insert(t.id);
      const Eigen::Vector2d error = t.left - exact[t.landmark].left;
      if (t.slipped) {
        slips += slipped.insert(t.id).second ? 1.0 : 0.0;
        EXPECT_LT(error.cwiseAbs().maxCoeff(), 3 * TrackSimulator::kSlip + 6.0);
        continue;
      }
      n += 1.0;
      u2 += error.squaredNorm() / 2.0;
      d2 += std::pow((t.left - t.right).x() - exact[t.landmark].disparity, 2);
    }
    for (const std::int64_t id : before) {
      offered += 1.0;
      lost += now.count(id) == 0 ? 1.0 : 0.0;
    }
    before = now;
  }
  EXPECT_NEAR(lost / offered, 0.02, 0.003);
  EXPECT_NEAR(slips / (offered - lost), 0.01, 0.003);  // a track may slip twice
  EXPECT_NEAR(u2 / n, 1.0, 0.05);
  EXPECT_NEAR(d2 / n, 2.0, 0.1);
}

TEST(TrackSimulator, ALandmarkThatComesBackIsANewTrack) {
  const Wall wall;
  TrackSpec spec;
  spec.lost = spec.wrong = 0.0;
  TrackSimulator tracker(spec, 3);
  const auto before = tracker.observe(wall.frame(), wall.landmarks());
  EXPECT_TRUE(tracker.observe(wall.frame({box_around(Vec3(1, 0, 1), Vec3(0.1, 5, 5))}), wall.landmarks()).empty());
  const auto after = tracker.observe(wall.frame(), wall.landmarks());
  ASSERT_EQ(after.size(), before.size());
  EXPECT_GT(after.front().id, before.back().id);
}

}  // namespace
}  // namespace tern
