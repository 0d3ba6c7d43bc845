#include "simulator/worlds/blind_corner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/base/random.h"
#include "core/scenario/blind_corner.h"
#include "simulator/worlds/obstacle.h"

namespace tern {
namespace {

const Vec3 kStart(0, 0, 1), kGoal(40, 0, 1);

struct Drawn {
  std::vector<WorldObstacle> obstacles;
  int gaps = 0;

  Drawn(int n, std::uint64_t seed) : gaps(n) {
    const auto specs = draw_blind_corner(n, seed, kStart, kGoal).value();
    for (std::size_t k = 0; k < specs.size(); ++k)
      obstacles.push_back(WorldObstacle::make(static_cast<std::int64_t>(k), specs[k]).value());
  }
  [[nodiscard]] Box wall_piece(std::size_t k) const { return obstacles[static_cast<std::size_t>(2 * gaps) + k].box(0); }
  [[nodiscard]] double half_width() const { return wall_piece(0).min().y(); }
  /// The walls' ends before and after a gap, x.
  [[nodiscard]] std::pair<double, double> gap(int k) const {
    const auto piece = static_cast<std::size_t>(2 * k);
    return {wall_piece(piece).max().x(), wall_piece(piece + 2).min().x()};
  }
};

/// Whether the segment meets the box (slabs).
bool meets(const Vec3& a, const Vec3& b, const Box& box) {
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b[axis] - a[axis];
    if (d == 0.0) {
      if (a[axis] < box.min()[axis] || a[axis] > box.max()[axis]) return false;
      continue;
    }
    const double t = (box.min()[axis] - a[axis]) / d, u = (box.max()[axis] - a[axis]) / d;
    first = std::max(first, std::min(t, u));
    last = std::min(last, std::max(t, u));
  }
  return first <= last;
}

TEST(BlindCorner, IsAPureFunctionOfTheSeed) {
  std::set<double> widths;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Drawn one(3, seed), same(3, seed);
    ASSERT_EQ(one.obstacles.size(), static_cast<std::size_t>(blind_corner_obstacles(3)));
    for (std::size_t k = 0; k < one.obstacles.size(); ++k)
      EXPECT_EQ(one.obstacles[k].at(3.0).p, same.obstacles[k].at(3.0).p);
    EXPECT_GE(one.half_width(), 1.0);
    EXPECT_LT(one.half_width(), 3.0);
    widths.insert(one.half_width());
  }
  EXPECT_EQ(widths.size(), 200U);
}

TEST(BlindCorner, HidesWhoeverWaitsFromTheCorridorBeforeTheGap) {
  Rng rng(5);
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Drawn world(4, seed);
    for (int k = 0; k < world.gaps; ++k) {
      const WorldObstacle& mover = world.obstacles[static_cast<std::size_t>(k)];
      const Box waits = mover.box(0.0);
      for (int ray = 0; ray < 200; ++ray) {
        const Vec3 eye(rng.uniform(kStart.x(), world.gap(k).first), rng.uniform(-1.0, 1.0) * world.half_width(), 1.0);
        const Vec3 seen(rng.uniform(waits.min().x(), waits.max().x()), rng.uniform(waits.min().y(), waits.max().y()),
                        1.0);
        bool hidden = false;
        for (std::size_t o = static_cast<std::size_t>(world.gaps); o < world.obstacles.size() && !hidden; ++o)
          hidden = meets(eye, seen, world.obstacles[o].box(0.0));
        EXPECT_TRUE(hidden) << "seed " << seed << ", gap " << k << ", from " << eye.transpose();
      }
    }
  }
}

TEST(BlindCorner, WalksThroughTheGapsAndTouchesNoWall) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Drawn world(4, seed);
    for (int k = 0; k < world.gaps; ++k) {
      const WorldObstacle& mover = world.obstacles[static_cast<std::size_t>(k)];
      EXPECT_LE(mover.bounds().speed.maxCoeff(), 2.0);
      const double side = mover.at(0.0).p.y();
      EXPECT_LT(side * mover.at(1e3).p.y(), 0.0) << "it ends behind the other wall";
      for (double t = 0.0; t < 40.0; t += 0.05) {
        const Box box = mover.box(t);
        for (std::size_t o = static_cast<std::size_t>(world.gaps); o < world.obstacles.size(); ++o)
          EXPECT_FALSE(box.intersects(world.obstacles[o].box(t))) << "seed " << seed << ", obstacle " << o;
        if (std::abs(mover.at(t).p.y()) > world.half_width()) continue;
        EXPECT_GE(box.min().x(), world.gap(k).first);
        EXPECT_LE(box.max().x(), world.gap(k).second);
      }
    }
  }
}

TEST(BlindCorner, NeedsRoomForItsGaps) {
  EXPECT_EQ(draw_blind_corner(0, 1, kStart, kGoal).value().size(), 0U);
  EXPECT_THAT(draw_blind_corner(6, 1, kStart, kGoal).error().message,
              testing::HasSubstr("6 gaps need a goal at least 42 m along x from the start; it is 40"));
}

}  // namespace
}  // namespace tern
