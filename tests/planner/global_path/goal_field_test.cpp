#include "planner/global_path/goal_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/base/random.h"
#include "core/world/box_cover.h"
#include "tests/support/path_length.h"
#include "tests/support/voxel_maps.h"

namespace tern {
namespace {

const Box kOpenWorld(Vec3::Constant(-1e4), Vec3::Constant(1e4));

/// Every sample of the path, 2 mm apart, lies outside every box and inside the flight box.
void expect_clear(const std::vector<Vec3>& path, const std::vector<Box>& boxes, const Box& flight_box) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int n = 1 + static_cast<int>((path[i] - path[i - 1]).norm() / 0.002);
    for (int k = 0; k <= n; ++k) {
      const Vec3 p = path[i - 1] + (path[i] - path[i - 1]) * (static_cast<double>(k) / n);
      ASSERT_TRUE(grown(flight_box, Vec3::Constant(1e-9)).contains(p)) << p.transpose();
      for (const Box& box : boxes) ASSERT_FALSE(box.contains(p)) << p.transpose();
    }
  }
}

/// Shortest way among boxes so tall that nothing passes over them: a visibility graph on their corners, by Dijkstra.
double visibility_graph_length(const std::vector<Box>& boxes, const Vec3& from, const Vec3& to) {
  std::vector<Vec3> points{from, to};
  for (const Box& box : boxes) {
    for (int corner = 0; corner < 4; ++corner) {
      const double x = (corner & 1) != 0 ? box.max().x() + 1e-5 : box.min().x() - 1e-5;
      const double y = (corner & 2) != 0 ? box.max().y() + 1e-5 : box.min().y() - 1e-5;
      points.emplace_back(x, y, from.z());
    }
  }
  const BoxIndex index(boxes);
  std::vector<double> best(points.size(), INFINITY);
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>, std::greater<>>
      queue;
  queue.emplace(best[0] = 0.0, 0);
  while (!queue.empty()) {
    const auto [length, i] = queue.top();
    queue.pop();
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double d = length + (points[i] - points[j]).norm();
      if (d >= best[j] || index.blocks(points[i], points[j])) continue;
      queue.emplace(best[j] = d, j);
    }
  }
  return best[1];
}

/// A wall across y ∈ [−4, 4], z ∈ [0, 4] at x ∈ [5, 5.4] with a square window.
std::vector<Box> wall_with_window(double y0, double z0, double side) {
  return {Box(Vec3(5, -4, 0), Vec3(5.4, y0, 4)), Box(Vec3(5, y0 + side, 0), Vec3(5.4, 4, 4)),
          Box(Vec3(5, y0, 0), Vec3(5.4, y0 + side, z0)), Box(Vec3(5, y0, z0 + side), Vec3(5.4, y0 + side, 4))};
}

std::vector<Box> inflated(std::vector<Box> boxes, double by) {
  for (Box& box : boxes) box = grown(box, Vec3::Constant(by));
  return boxes;
}

TEST(GoalField, IsTheStraightLineInTheOpen) {
  const GoalField field = GoalField::build({}, kOpenWorld, Vec3(75, -1, 1));
  const auto path = field.path_from(Vec3(0, 0, 1));
  ASSERT_TRUE(path);
  EXPECT_EQ(*path, (std::vector<Vec3>{Vec3(0, 0, 1), Vec3(75, -1, 1)}));
}

TEST(GoalField, PathsAreClearAndNearlyShortestAmongPillars) {
  const Box flight_box(Vec3(-1, -3, 0.1), Vec3(21, 3, 3.9));
  double worst = 1.0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    std::vector<Box> boxes;
    for (int i = 0; i < 15; ++i) {
      const double x = rng.uniform(2, 18);
      boxes.push_back(box_around(Vec3(x, rng.uniform(-2.5, 2.5), 2.0), Vec3(0.35, 0.35, 8.0)));
    }
    const Vec3 start(0, 0, 1);
    const GoalField field = GoalField::build(boxes, flight_box, Vec3(20, -1, 1));
    const auto path = field.path_from(start);
    const double shortest = visibility_graph_length(boxes, start, Vec3(20, -1, 1));
    ASSERT_EQ(path.has_value(), std::isfinite(shortest));
    if (!path) continue;
    expect_clear(*path, boxes, flight_box);
    worst = std::max(worst, path_length(*path) / shortest);
  }
  EXPECT_LT(worst, 1.01);
}

TEST(GoalField, FliesOverAWallThatIsWiderThanHigh) {
  const std::vector<Box> boxes{Box(Vec3(5, -20, -5), Vec3(6, 20, 3))};
  const Box flight_box(Vec3(-1, -21, 0), Vec3(12, 21, 8));
  const GoalField field = GoalField::build(boxes, flight_box, Vec3(11, 0, 1));
  const auto path = field.path_from(Vec3(0, 0, 1));
  ASSERT_TRUE(path);
  expect_clear(*path, boxes, flight_box);
  const double shortest = std::hypot(5.0, 2.0) + 1.0 + std::hypot(5.0, 2.0);
  EXPECT_LT(path_length(*path), 1.01 * shortest);
  EXPECT_GE(path_length(*path), shortest);
}

TEST(GoalField, AWindowOfSixtyCentimetresStaysOpenWhereverItLies) {
  const Box flight_box(Vec3(-1, -3.9, 0.1), Vec3(11, 3.9, 3.9));
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const double at = 0.01 * i;
    const std::vector<Box> boxes = inflated(wall_with_window(1.0 + at, 2.0 - 1.3 * at, 0.6), 0.1);
    const GoalField field = GoalField::build(boxes, flight_box, Vec3(10, 0, 1));
    const auto path = field.path_from(Vec3(0, 0, 1));
    ASSERT_TRUE(path);
    expect_clear(*path, boxes, flight_box);
  }
}

TEST(GoalField, AWindowNarrowerThanTheGridStaysOpenUntilItIsShut) {
  const Box flight_box(Vec3(-1, -3.9, 0.1), Vec3(11, 3.9, 3.9));
  GoalFieldOptions coarse;
  coarse.resolution = 0.7;
  for (const double side : {0.201, 0.21, 0.3, 0.45}) {
    const std::vector<Box> boxes = inflated(wall_with_window(1.03, 1.97, side), 0.1);
    EXPECT_TRUE(GoalField::build(boxes, flight_box, Vec3(10, 0, 1), coarse).path_from(Vec3(0, 0, 1))) << side;
  }
  const std::vector<Box> shut = inflated(wall_with_window(1.03, 1.97, 0.2), 0.1);
  EXPECT_FALSE(GoalField::build(shut, flight_box, Vec3(10, 0, 1)).path_from(Vec3(0, 0, 1)));
}

TEST(GoalField, AWindowOfSixtyCentimetresStaysOpenInAMapOfQuarterMetres) {
  const Box flight_box(Vec3(-0.9, -3.9, 0.1), Vec3(10.9, 3.9, 3.9));
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    // The wall's boxes as a mapper voxelizes them: every voxel that they touch is occupied.
    VoxelMap map = support::free_map({48, 32, 16}, 0.25, Vec3(-1, -4, 0));
    const std::vector<Box> wall = wall_with_window(0.025 * i, 2.0 + 0.0125 * i, 0.6);
    for (std::size_t v = 0; v < map.labels.size(); ++v) {
      const Box voxel = grown(map.grid.box(map.grid.cell(static_cast<std::int64_t>(v))), Vec3::Constant(-1e-9));
      for (const Box& box : wall) {
        if (box.intersects(voxel)) map.labels[v] = VoxelLabel::Occupied;
      }
    }
    const std::vector<Box> boxes = inflated(cover_with_boxes(map, true), 0.1);
    const GoalField field = GoalField::build(boxes, flight_box, Vec3(10, 0, 1));
    const auto path = field.path_from(Vec3(0, 0, 1));
    ASSERT_TRUE(path);
    expect_clear(*path, boxes, flight_box);
  }
}

TEST(GoalField, LeavesAUTrap) {
  const std::vector<Box> boxes{Box(Vec3(6, -3, -10), Vec3(6.5, 3, 10)), Box(Vec3(1, -3, -10), Vec3(6.5, -2.5, 10)),
                               Box(Vec3(1, 2.5, -10), Vec3(6.5, 3, 10))};
  const Box flight_box(Vec3(-3, -6, 0), Vec3(12, 6, 3));
  const Vec3 start(5, 0.3, 1);
  const GoalField field = GoalField::build(boxes, flight_box, Vec3(10, 0, 1));
  const auto path = field.path_from(start);
  ASSERT_TRUE(path);
  expect_clear(*path, boxes, flight_box);
  EXPECT_LT(path_length(*path), 1.01 * visibility_graph_length(boxes, start, Vec3(10, 0, 1)));
  EXPECT_GT(path_length(*path), 10.0) << "not the 5 m through the wall";
}

TEST(GoalField, SaysNothingWhenTheGoalIsBlocked) {
  const std::vector<Box> boxes{Box(Vec3(9, -1, 0), Vec3(11, 1, 2))};
  const Box flight_box(Vec3(-1, -3, 0), Vec3(12, 3, 3));
  const GoalField inside = GoalField::build(boxes, flight_box, Vec3(10, 0, 1));
  EXPECT_FALSE(inside.path_from(Vec3(0, 0, 1)));
  EXPECT_FALSE(GoalField::build(boxes, flight_box, Vec3(10, 4, 1)).path_from(Vec3(0, 0, 1)))
      << "outside the flight box";

  const std::vector<Box> wall{Box(Vec3(5, -4, -1), Vec3(6, 4, 4))};
  const GoalField behind = GoalField::build(wall, flight_box, Vec3(10, 0, 1));
  EXPECT_FALSE(behind.path_from(Vec3(0, 0, 1)));
  EXPECT_TRUE(behind.path_from(Vec3(7, 0, 1)));
}

TEST(GoalField, NamesTheBoxThatBlocks) {
  const Box flight_box(Vec3(-1, -3, 0), Vec3(12, 3, 3));
  const Vec3 start(0, 0, 1);
  const Box wall(Vec3(5, -4, -1), Vec3(6, 4, 4)), post(Vec3(2, 1, 0), Vec3(2.2, 1.2, 3)),
      held(Vec3(9, -1, 0), Vec3(11, 1, 2));
  const auto blocker = [&](const std::vector<Box>& boxes, const Vec3& goal) {
    const GoalField field = GoalField::build(boxes, flight_box, goal);
    EXPECT_FALSE(field.path_from(start));
    return field.blocker(start);
  };
  const auto behind = blocker({post, wall}, Vec3(8, 0, 1));
  ASSERT_TRUE(behind);
  EXPECT_TRUE(behind->isApprox(wall));
  const auto inside = blocker({post, held}, Vec3(10, 0, 1));
  ASSERT_TRUE(inside);
  EXPECT_TRUE(inside->isApprox(held));
  EXPECT_FALSE(blocker({post}, Vec3(10, 4, 1))) << "outside the flight box";
}

TEST(GoalField, LetsAStartInsideABoxLeaveIt) {
  const std::vector<Box> boxes{Box(Vec3(-1, -1, -1), Vec3(1, 1, 3)), Box(Vec3(4, -2, -1), Vec3(5, 2, 5))};
  const Box flight_box(Vec3(-2, -4, 0), Vec3(12, 4, 4));
  const GoalField field = GoalField::build(boxes, flight_box, Vec3(10, 0, 1));
  const auto path = field.path_from(Vec3(0.8, 0, 1));
  ASSERT_TRUE(path);
  expect_clear(*path, {boxes[1]}, flight_box);
}

TEST(GoalField, WorksFromOutsideTheRegionSearched) {
  const std::vector<Box> boxes{Box(Vec3(5, -3, -3), Vec3(6, 3, 6))};
  const GoalField field = GoalField::build(boxes, kOpenWorld, Vec3(10, 0, 1));
  EXPECT_LT(field.nodes(), 200'000);
  const Vec3 start(-300, 40, 20);
  const auto path = field.path_from(start);
  ASSERT_TRUE(path);
  expect_clear(*path, boxes, kOpenWorld);
  EXPECT_LT(path_length(*path), 1.05 * (Vec3(10, 0, 1) - start).norm());
}

TEST(GoalField, IsTheSameWhateverTheOrderOfTheBoxes) {
  std::vector<Box> boxes = inflated(wall_with_window(1.0, 2.0, 0.6), 0.1);
  const Box flight_box(Vec3(-1, -3.9, 0.1), Vec3(11, 3.9, 3.9));
  const auto first = GoalField::build(boxes, flight_box, Vec3(10, 0, 1)).path_from(Vec3(0, 0, 1));
  std::reverse(boxes.begin(), boxes.end());
  const auto second = GoalField::build(boxes, flight_box, Vec3(10, 0, 1)).path_from(Vec3(0, 0, 1));
  EXPECT_EQ(*first, *second);
}

/// `lambda` per metre inside the box, exactly.
TravelCost cost_inside(const Box& box, double lambda) {
  return {[=](const Vec3& a, const Vec3& b) {
            double from = 0.0;
            double to = 1.0;
            for (int axis = 0; axis < 3; ++axis) {
              const double d = b[axis] - a[axis];
              if (d == 0.0 && (a[axis] < box.min()[axis] || a[axis] > box.max()[axis])) return 0.0;
              if (d == 0.0) continue;
              const double t0 = (box.min()[axis] - a[axis]) / d;
              const double t1 = (box.max()[axis] - a[axis]) / d;
              from = std::max(from, std::min(t0, t1));
              to = std::min(to, std::max(t0, t1));
            }
            return lambda * (b - a).norm() * std::max(0.0, to - from);
          },
          box};
}

double cost_of(const std::vector<Vec3>& path, const TravelCost& cost) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += cost(path[i - 1], path[i]);
  return sum;
}

/// The cheapest way past a region that is cheapest passed along its side y = top: two slants and the side.
double length_around(const Box& region, const Vec3& from, const Vec3& to) {
  const double top = region.max().y();
  const Vec3 a(region.min().x(), top, from.z());
  const Vec3 b(region.max().x(), top, to.z());
  return (a - from).norm() + (b - a).norm() + (to - b).norm();
}

TEST(GoalFieldWithCost, LeadsAroundARegionThatIsDearerThanTheDetour) {
  const Box region(Vec3(6, -3, -50), Vec3(14, 0.5, 50));
  const Vec3 start(0, 0, 1);
  const Vec3 goal(20, -1, 1);
  GoalFieldOptions options;
  options.start = start;
  options.cost = cost_inside(region, 2.0);
  const Box flight_box(Vec3(-5, -10, 0), Vec3(30, 10, 2));
  const auto path = GoalField::build({}, flight_box, goal, options).path_from(start);
  ASSERT_TRUE(path);
  EXPECT_LE(cost_of(*path, options.cost), 1.02 * length_around(region, start, goal));
  EXPECT_LE(cost_of(*path, options.cost) - path_length(*path), 0.1) << "metres inside";
}

TEST(GoalFieldWithCost, CutsACornerWhereTheDetourIsDearer) {
  const Box region(Vec3(9.5, -8, -50), Vec3(10.5, 8, 50));
  GoalFieldOptions options;
  options.start = Vec3(0, 0, 1);
  options.cost = cost_inside(region, 2.0);
  const Box flight_box(Vec3(-5, -20, 0), Vec3(30, 20, 2));
  const auto path = GoalField::build({}, flight_box, Vec3(20, 0, 1), options).path_from(Vec3(0, 0, 1));
  ASSERT_TRUE(path);
  EXPECT_NEAR(cost_of(*path, options.cost), 22.0, 0.05) << "straight through: 20 m and 2 for the metre inside";
}

TEST(GoalFieldWithCost, CrossesWhatBlocksTheWholeWayByTheShortestWay) {
  // In the region every metre counts nine times, so refraction bends the diagonal path towards its normal.
  const Box region(Vec3(8, -50, -50), Vec3(12, 50, 50));
  GoalFieldOptions options;
  options.start = Vec3(0, -3, 1);
  options.cost = cost_inside(region, 8.0);
  const Box flight_box(Vec3(-2, -4, 0), Vec3(22, 4, 2));
  const auto path = GoalField::build({}, flight_box, Vec3(20, 3, 1), options).path_from(Vec3(0, -3, 1));
  ASSERT_TRUE(path);
  const double inside = (cost_of(*path, options.cost) - path_length(*path)) / 8.0;
  EXPECT_LE(inside, 4.1);
  EXPECT_LE(path_length(*path), 1.05 * std::sqrt(20.0 * 20.0 + 6.0 * 6.0));
}

TEST(GoalFieldWithCost, ReachesAGoalAndLeavesAStartInsideARegion) {
  const Box region(Vec3(8, -2, -50), Vec3(30, 6, 50));
  GoalFieldOptions options;
  options.start = Vec3(0, 0, 1);
  options.cost = cost_inside(region, 4.0);
  const Box flight_box(Vec3(-5, -10, 0), Vec3(40, 10, 2));
  const Vec3 inside(19, 0, 1);
  const auto in = GoalField::build({}, flight_box, inside, options).path_from(Vec3(0, 0, 1));
  ASSERT_TRUE(in);
  const double metres = (cost_of(*in, options.cost) - path_length(*in)) / 4.0;
  EXPECT_LE(metres, 2.6) << "from the near side, 2 m, not from the front, 11 m";
  EXPECT_EQ(in->back(), inside);
  const auto out = GoalField::build({}, flight_box, Vec3(0, 0, 1), options).path_from(inside);
  ASSERT_TRUE(out);
  EXPECT_NEAR(cost_of(*out, options.cost), cost_of(*in, options.cost), 0.1);
}

TEST(GoalFieldWithCost, StillLeadsAroundBoxesAndStaysClear) {
  const std::vector<Box> boxes = wall_with_window(2.0, 0.0, 2.0);
  GoalFieldOptions options;
  options.start = Vec3(0, 0, 1);
  options.cost = cost_inside(Box(Vec3(1, -0.5, -50), Vec3(4, 1.5, 50)), 3.0);
  const Box flight_box(Vec3(-2, -4, 0), Vec3(12, 4, 4));
  const auto path = GoalField::build(boxes, flight_box, Vec3(10, 0, 1), options).path_from(Vec3(0, 0, 1));
  ASSERT_TRUE(path);
  expect_clear(*path, boxes, flight_box);
  EXPECT_LE(cost_of(*path, options.cost) - path_length(*path), 0.3);
}

}  // namespace
}  // namespace tern
