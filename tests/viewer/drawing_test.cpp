// Data for drawing: faces of voxels, predicted hulls, the past of a flight.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "core/drawing/predicted_hulls.h"
#include "core/geometry/box.h"
#include "core/wire/message_limits.h"
#include "tests/viewer/known_scene.h"
#include "viewer/bridge/scene.h"
#include "viewer/bridge/scene_json.h"
#include "viewer/bridge/voxel_faces.h"

namespace tern {
namespace {

using nlohmann::json;

VoxelMap random_map(const Eigen::Vector3i& size, const std::vector<int>& labels) {
  VoxelMap map;
  map.grid.size = size;
  for (std::int64_t k = 0; k < map.grid.voxels(); ++k) {
    map.labels.push_back(static_cast<VoxelLabel>(labels[static_cast<std::size_t>(k) % labels.size()]));
  }
  return map;
}

using UnitFace = std::tuple<int, int, int, int, int>;  // direction, label, voxel

/// Oracle: every face of every drawn voxel whose neighbour has another label.
std::set<UnitFace> exposed_faces(const VoxelMap& map) {
  std::set<UnitFace> faces;
  for (std::int64_t k = 0; k < map.grid.voxels(); ++k) {
    const VoxelLabel label = map.labels[static_cast<std::size_t>(k)];
    if (label < VoxelLabel::Occupied) continue;
    const Eigen::Vector3i cell = map.grid.cell(k);
    for (int direction = 0; direction < 6; ++direction) {
      Eigen::Vector3i next = cell;
      next[direction / 2] += direction % 2 == 0 ? -1 : 1;
      const bool same = map.grid.contains(next) && map.labels[static_cast<std::size_t>(map.grid.index(next))] == label;
      if (!same) faces.insert({direction, static_cast<int>(label), cell.x(), cell.y(), cell.z()});
    }
  }
  return faces;
}

RC_GTEST_PROP(VoxelSurface, CoversEachExposedFaceOnceAndNothingElse, ()) {
  const auto axis = rc::gen::inRange(1, 6);
  const Eigen::Vector3i size(*axis, *axis, *axis);
  const auto labels = *rc::gen::container<std::vector<int>>(7, rc::gen::inRange(0, kVoxelLabels));
  const VoxelMap map = random_map(size, labels);
  std::set<UnitFace> covered;
  for (const VoxelFace& face : voxel_surface(map).faces) {
    const int axis_of = face.direction / 2;
    RC_ASSERT(face.low[axis_of] == face.high[axis_of]);
    Eigen::Vector3i low = face.low, high = face.high;
    low[axis_of] -= face.direction % 2;
    high[axis_of] = low[axis_of] + 1;
    for (int x = low.x(); x < high.x(); ++x) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int z = low.z(); z < high.z(); ++z) {
          RC_ASSERT(covered.insert({face.direction, static_cast<int>(face.label), x, y, z}).second);
        }
      }
    }
  }
  RC_ASSERT(covered == exposed_faces(map));
}

TEST(VoxelSurface, CoarsensWhatIsTooLargeAndLosesNoHazard) {
  VoxelMap map = random_map({40, 40, 40}, {static_cast<int>(VoxelLabel::Free)});
  map.labels[static_cast<std::size_t>(map.grid.index({21, 5, 33}))] = VoxelLabel::Repulsive;
  const VoxelSurface surface = voxel_surface(map, 1'000);
  EXPECT_EQ(surface.grid.resolution, 4 * map.grid.resolution);
  ASSERT_EQ(surface.faces.size(), 6U);
  EXPECT_EQ(surface.faces.front().low, Eigen::Vector3i(5, 1, 8));
}

TEST(VoxelSurface, CoarsensAWallBesideAHazardToAWall) {
  VoxelMap map = random_map({40, 40, 40}, {static_cast<int>(VoxelLabel::Free)});
  map.labels[static_cast<std::size_t>(map.grid.index({21, 5, 33}))] = VoxelLabel::Repulsive;
  map.labels[static_cast<std::size_t>(map.grid.index({22, 5, 33}))] = VoxelLabel::Occupied;
  EXPECT_EQ(voxel_surface(map, 1'000).faces.front().label, VoxelLabel::Occupied);
}

RC_GTEST_PROP(VoxelSurface, TellsTheDistanceToWhatIsOccupied, ()) {
  const auto axis = rc::gen::inRange(1, 6);
  const Eigen::Vector3i size(*axis, *axis, *axis);
  const auto labels = *rc::gen::container<std::vector<int>>(7, rc::gen::inRange(0, kVoxelLabels));
  const VoxelMap map = random_map(size, labels);
  const auto coordinate = rc::gen::map(rc::gen::inRange(-300, 500), [](int cm) { return 0.01 * cm; });
  const Vec3 p(*coordinate, *coordinate, *coordinate);
  const auto half = rc::gen::map(rc::gen::inRange(0, 40), [](int cm) { return 0.01 * cm; });
  const Points corners = box_corners(box_around(Vec3::Zero(), Vec3(*half, *half, *half)));
  const BodyDistance body({*rc::gen::element(Points(corners), Points(corners.leftCols(5))), *half});
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int64_t k = 0; k < map.grid.voxels(); ++k) {
    if (map.labels[static_cast<std::size_t>(k)] != VoxelLabel::Occupied) continue;
    const Box voxel = map.grid.box(map.grid.cell(k));
    nearest = std::min(nearest, body(p - voxel.center(), 0.5 * voxel.sizes()));
  }
  const double told = distance_to_occupied(voxel_surface(map), body, p);
  if (nearest > 1e-9) RC_ASSERT(told == nearest || std::abs(told - nearest) < 1e-9);
  if (nearest < -1e-9) RC_ASSERT(told <= 0.0);
}

TEST(PredictedHulls, HoldTheObstacleAtEveryInstant) {
  const UTime start{1'000'000'000};
  const support::KnownScene scene(start);
  TrackSet tracks = scene.predictions(start);
  for (Track& track : tracks.tracks) {
    track.motion.pieces.front().coefficients.col(1) = Vec3(0.3, -0.8, 0.5);           // curved
    if (track.id % 2 == 0) track.motion.pieces.front().duration = Duration{400'000};  // ends within the plan
  }
  const TimedSpline plan = scene.request(start, 1).committed;
  const PredictedHulls made = predicted_hulls(tracks, plan, kMaxSpan, 20.0, 1'000);
  EXPECT_EQ(made.left_out, 0);
  EXPECT_EQ(made.hulls.size(), static_cast<std::size_t>(support::kKnownMovers * plan.spline().intervals()));
  for (const PredictedHull& hull : made.hulls) {
    const Track& track = tracks.tracks[static_cast<std::size_t>(hull.track)];
    for (int k = 0; k <= 20; ++k) {
      const UTime t = plan.start + plan.interval * hull.interval + Duration{plan.interval.us * k / 20};
      const Box promised = track.bounds(t, t);
      // A hull contains a box if it reaches as far in every direction; axes and diagonals are checked.
      for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(1, -1, 0.5)}) {
        for (const Vec3& n : {d, Vec3(-d)}) {
          const double box = n.dot(promised.center()) + 0.5 * n.cwiseAbs().dot(promised.sizes());
          EXPECT_GE((n.transpose() * hull.points).maxCoeff(), box - 1e-9);
        }
      }
    }
  }
}

TEST(PredictedHulls, AreOfTheIntervalsThatBeginInTime) {
  const UTime start{1'000'000'000};
  const support::KnownScene scene(start);
  const TimedSpline plan = scene.request(start, 1).committed;  ///< intervals of 0.2 s
  const PredictedHulls made = predicted_hulls(scene.predictions(start), plan, Duration{1'000'000}, 20.0, 1'000);
  EXPECT_EQ(made.hulls.size(), 5U * support::kKnownMovers);
  for (const PredictedHull& hull : made.hulls) EXPECT_LT(hull.interval, 5);
}

TEST(PredictedHulls, AreBoundedNearestFirst) {
  const UTime start{1'000'000'000};
  const support::KnownScene scene(start);
  const TimedSpline plan = scene.request(start, 1).committed;
  const PredictedHulls made = predicted_hulls(scene.predictions(start), plan, kMaxSpan, 20.0, 5);
  ASSERT_EQ(made.hulls.size(), 5U);
  EXPECT_EQ(made.left_out, support::kKnownMovers * plan.spline().intervals() - 5);
  EXPECT_LE(made.hulls.front().points.row(0).minCoeff(), 6.0);  ///< no hull of those 18 m away
}

/// The places at which the planes of a plan are drawn.
std::vector<Vec3> plane_places(const HorizonRequest& request, const Plan& plan) {
  Scene scene;
  scene.receive(request);
  scene.receive(plan);
  std::vector<Vec3> places;
  const json told = json::parse(plan_json(scene, true));
  for (const json& plane : told["planes"]) {
    places.emplace_back(plane["at"][0], plane["at"][1], plane["at"][2]);
  }
  return places;
}

TEST(Planes, StandAtTheirPartOfTheirIntervalCountedFromTheRequestsStart) {
  const support::KnownScene known(UTime{1'000'000'000});
  HorizonRequest request = known.request(UTime{1'000'000'000}, 1);
  Plan plan = known.plan(request);
  const Plane plane = plan.certificate.front().plane;
  plan.certificate = {{0, 0, 0, 1, plane}, {0, 0, 1, 2, plane}, {0, 1, 3, 4, plane}};
  const auto expect_at = [&](const std::vector<double>& intervals) {
    const std::vector<Vec3> places = plane_places(request, plan);
    ASSERT_EQ(places.size(), intervals.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Duration passed = Duration::from_seconds(intervals[k] * plan.trajectory.interval.seconds());
      // With the digits that JsonWriter writes, and whole microseconds at 1 m/s.
      EXPECT_NEAR((places[k] - plan.trajectory.sample(plan.trajectory.start + passed).p).norm(), 0.0, 2e-3) << k;
    }
  };
  expect_at({0.5, 0.75, 1.875});
  plan.outcome = PlanOutcome::KeepCommitted;  ///< 2.4 of its intervals are over at t_s
  request.t_s = plan.trajectory.start + Duration::from_seconds(2.4 * plan.trajectory.interval.seconds());
  expect_at({2.7, 2.85, 3.875});
}

}  // namespace
}  // namespace tern
