// The space that geofences forbid, as voxels.
#include "core/world/fence_voxels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "semantic_mapper/voxel_map/live_map.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {
namespace {

using ::testing::HasSubstr;

Fence fence_of(std::vector<Eigen::Vector2d> corners, bool inclusion = true) {
  Fence fence;
  fence.is_inclusion = inclusion;
  fence.shape = FencePolygon{std::move(corners)};
  return fence;
}

Fence circle_of(const Eigen::Vector2d& centre, double radius, bool inclusion) {
  Fence fence;
  fence.is_inclusion = inclusion;
  fence.shape = FenceCircle{centre, radius};
  return fence;
}

VoxelGrid grid_of(const Vec3& origin, double resolution, const Eigen::Vector3i& size) {
  return {origin, resolution, size};
}

/// Whether a point is allowed: inside an inclusion fence, if there is one, and outside of all exclusion fences.
bool contains(const Fence& fence, const Vec3& p) {
  if (p.z() < fence.floor || p.z() > fence.ceiling) return false;
  if (const auto* circle = std::get_if<FenceCircle>(&fence.shape)) {
    return (p.head<2>() - circle->centre).norm() <= circle->radius;
  }
  const auto& corners = std::get<FencePolygon>(fence.shape).corners;
  bool inside = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside;
}

bool is_allowed(const std::vector<Fence>& fences, const Vec3& p) {
  bool has_inclusion = false, is_included = false;
  for (const Fence& fence : fences) {
    if (!fence.is_inclusion && contains(fence, p)) return false;
    has_inclusion = has_inclusion || fence.is_inclusion;
    is_included = is_included || (fence.is_inclusion && contains(fence, p));
  }
  return !has_inclusion || is_included;
}

double uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 1'000'001)) * 1e-6;
}

/// A star-shaped polygon, so that it is simple.
Fence random_polygon(bool inclusion) {
  const int count = *rc::gen::inRange(3, 9);
  const Eigen::Vector2d centre(uniform(-4, 4), uniform(-4, 4));
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + uniform(0.0, 0.8)) / count, reach = uniform(1.0, 5.0);
    corners.emplace_back(centre + reach * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return fence_of(std::move(corners), inclusion);
}

RC_GTEST_PROP(FenceVoxels, AllowOnlyWhatTheFencesAllow, ()) {
  std::vector<Fence> fences;
  const int count = *rc::gen::inRange(1, 4);
  for (int k = 0; k < count; ++k) {
    const bool inclusion = *rc::gen::arbitrary<bool>();
    fences.push_back(*rc::gen::arbitrary<bool>()
                         ? random_polygon(inclusion)
                         : circle_of({uniform(-4, 4), uniform(-4, 4)}, uniform(0.3, 5.0), inclusion));
    if (*rc::gen::arbitrary<bool>()) fences.back().floor = uniform(-3.0, 0.0);
    if (*rc::gen::arbitrary<bool>()) fences.back().ceiling = uniform(0.5, 3.0);
  }
  const VoxelGrid grid = grid_of({-7.0, -7.0, -3.0}, 0.5, {28, 28, 12});
  const auto labels = fence_labels(fences, grid);
  for (int k = 0; k < 400; ++k) {
    const Vec3 p(uniform(-6.99, 6.99), uniform(-6.99, 6.99), uniform(-2.99, 2.99));
    const bool is_free = labels[idx(grid.index(grid.cell_of(p)))] != VoxelLabel::Occupied;
    RC_ASSERT(!is_free || is_allowed(fences, p));
  }
}

RC_GTEST_PROP(FenceVoxels, ForbidLessThanAVoxelsDiagonalBesideAFence, ()) {
  const Fence fence = *rc::gen::arbitrary<bool>() ? random_polygon(true) : circle_of({0.1, 0.2}, 3.3, true);
  const VoxelGrid grid = grid_of({-10.0, -10.0, 0.0}, 0.25, {80, 80, 1});
  const auto labels = fence_labels({fence}, grid);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p(uniform(-9.5, 9.5), uniform(-9.5, 9.5), 0.1);
    bool is_deep = true;
    for (int turn = 0; turn < 64; ++turn) {
      for (const double reach : {0.09, 0.18, 0.27, 0.36}) {
        const double angle = turn * std::numbers::pi / 32.0;
        is_deep = is_deep && is_allowed({fence}, p + reach * Vec3(std::cos(angle), std::sin(angle), 0.0));
      }
    }
    RC_ASSERT(!is_deep || labels[idx(grid.index(grid.cell_of(p)))] != VoxelLabel::Occupied);
  }
}

TEST(FenceVoxels, AFenceOnTheGridsPlanesLosesNothing) {
  Fence fence = fence_of({{1, 1}, {3, 1}, {3, 2}, {1, 2}});
  fence.floor = 0.5;
  fence.ceiling = 1.5;
  const VoxelGrid grid = grid_of({0, 0, 0}, 0.5, {10, 10, 6});
  const auto labels = fence_labels({fence}, grid);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), VoxelLabel::Unknown), 4 * 2 * 2);
  fence.is_inclusion = false;
  const auto inverse = fence_labels({fence}, grid);
  EXPECT_EQ(std::count(inverse.begin(), inverse.end(), VoxelLabel::Occupied), 4 * 2 * 2);
}

MapSources sources_of(std::vector<Fence> fences) {
  MapSources sources;
  sources.fences = std::move(fences);
  return sources;
}

MapBuildOptions options_in(const Box& flight_box) {
  MapBuildOptions options;
  options.resolution = 0.5;
  options.include = flight_box;
  options.somewhere = Vec3(2, 2, 1);
  options.body.emplace();
  return options;
}

const Box kFlightBox(Vec3(-20, -20, 0), Vec3(20, 20, 10));

TEST(FencedMap, HasAWallAroundAnInclusionFence) {
  const VoxelMap map = build_map(sources_of({fence_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}})}), options_in(kFlightBox))->map;
  const auto label = [&](const Vec3& p) { return map.labels[idx(map.grid.index(map.grid.cell_of(p)))]; };
  EXPECT_EQ(label({2, 2, 1}), VoxelLabel::Free);
  for (const Vec3& p : {Vec3(-0.1, 2, 1), Vec3(4.1, 2, 1), Vec3(2, -0.1, 1), Vec3(2, 4.1, 9.9)}) {
    EXPECT_EQ(label(p), VoxelLabel::Occupied) << p.transpose();
    EXPECT_EQ(map.class_names[map.classes[idx(map.grid.index(map.grid.cell_of(p)))]], "fence");
  }
}

TEST(FencedMap, RefusesAVehicleBeyondAFence) {
  auto options = options_in(kFlightBox);
  options.somewhere = Vec3(0.05, 2, 1);  // its body leaves the fence
  const auto map = build_map(sources_of({fence_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}})}), options);
  ASSERT_FALSE(map.has_value());
  EXPECT_THAT(map.error().message, HasSubstr("the vehicle at uav.start, (0.05, 2, 1) m, is beyond a fence"));
}

TEST(FencedMap, RefusesExtentsThatEndWithinAFence) {
  auto options = options_in(kFlightBox);
  options.extents = Box(Vec3(-1, -1, 0), Vec3(3, 5, 10));
  const auto map = build_map(sources_of({fence_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}})}), options);
  ASSERT_FALSE(map.has_value());
  EXPECT_THAT(map.error().message, HasSubstr("they must contain (-0.5, -0.5, 0) to (4.5, 4.5, 10) m"));
}

TEST(FencedMap, ScansDoNotFreeAFence) {
  const VoxelMap map = build_map(sources_of({fence_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}})}), options_in(kFlightBox))->map;
  LiveMap live(map, ClassMeanings(), ScanRange());
  Scan scan;
  scan.sensor = Vec3(2, 2, 1);
  scan.points.push_back({Vec3(15, 2, 1), 0});
  for (int k = 0; k < 20; ++k) live.add(scan);
  const VoxelMap now = live.map(Body(), Vec3(3.95, 2, 1));  // the vehicle even touches the fence
  for (std::size_t k = 0; k < map.labels.size(); ++k) {
    ASSERT_TRUE(map.labels[k] != VoxelLabel::Occupied || now.labels[k] == VoxelLabel::Occupied) << k;
  }
}

}  // namespace
}  // namespace tern
