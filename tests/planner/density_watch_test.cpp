// Densities of landmarks as seen in simulated flights: LandmarkField and TrackSimulator make what the camera tracks.
#include "planner/density_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulator/inertial/track_simulator.h"
#include "tests/support/effort.h"
#include "tests/support/path_length.h"

namespace tern {
namespace {

constexpr std::int64_t kFramePeriod = 50'000;

/// A region of one class from x = 10 to 60 m, on both sides of the way, seen from a vehicle that flies along x.
struct Flight {
  std::string class_name = "water";
  double promised = 0.03, truth = 0.03;  ///< 1/m², of the class
  Box region{Vec3(10, -20, 0), Vec3(60, 20, 0.5)};
  VoxelLabel label = VoxelLabel::Repulsive;
  double speed = 4.0, height = 1.2, duration = 12.0;  ///< m/s, m, s
  std::uint64_t seed = 1;
  std::vector<ObstacleSpec> obstacles;
  double promised_obstacles = 4.0;  ///< true
  bool knows_movers = true;
  double pose_error = 0.0;  ///< standard deviation of the stated position, m per axis
};

double seconds(UTime at) { return (at - UTime{}).seconds(); }

VoxelMap map_of(const Flight& flight) {
  VoxelMap map;
  map.grid.origin = Vec3(-10, -22, 0);
  map.grid.resolution = 0.5;
  map.grid.size = {160, 88, 8};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {"", flight.class_name};
  map.version = 1;
  for (std::int64_t i = 0; i < map.grid.voxels(); ++i) {
    if (!flight.region.contains(map.grid.centre(map.grid.cell(i)))) continue;
    map.labels[idx(i)] = flight.label;
    map.classes[idx(i)] = 1;
  }
  return map;
}

PlannerConfig config_of(const Flight& flight) {
  PlannerConfig config;
  config.error_price.error_price = 20.0;
  config.error_price.landmarks.obstacles = flight.promised_obstacles;
  config.error_price.landmarks.regions = {{flight.class_name, flight.promised}};
  return config;
}

TrackSet tracks_at(const World& world, UTime at, bool knows_movers) {
  TrackSet set;
  set.made_at = at;
  for (std::size_t k = 0; k < world.obstacles.size(); ++k) {
    const WorldObstacle& obstacle = world.obstacles[k];
    if (obstacle.moves() && !knows_movers) continue;
    Track track;
    track.id = static_cast<std::int64_t>(k);
    track.kind = obstacle.moves() ? TrackKind::Declared : TrackKind::Static;
    track.half_extents = obstacle.half_extents();
    PowerCubic place = PowerCubic::Zero();
    place.col(3) = obstacle.at(seconds(at)).p;
    track.motion.start = at;
    track.motion.pieces = {CubicPiece{Duration{500'000}, place}};
    track.alpha = {Vec3::Zero()};
    set.tracks.push_back(track);
  }
  return set;
}

/// The densities at the end of a flight, and the lines that were logged.
struct Seen {
  DensityWatch watch;
  std::vector<std::string> lines;
  std::optional<SurfaceDensities> in_force;
  [[nodiscard]] double of(SurfaceKind kind) const { return watch.densities()->seen(kind); }
};

class SimulatedCamera {
 public:
  explicit SimulatedCamera(const Flight& flight) : flight_(flight), tracker_({}, flight.seed) {
    Scenario scenario;
    scenario.world.obstacles = flight.obstacles;
    world_ = make_world(scenario, "").value();
    LandmarkSpec spec;
    spec.regions = {{flight.class_name, flight.truth}};
    field_.emplace(world_, std::vector<Region>{{"region", flight.class_name, flight.region}}, spec, flight.seed);
  }

  [[nodiscard]] InertialState state_at(double t) const {
    InertialState state;
    state.p = Vec3(flight_.speed * t, 0.0, flight_.height);
    state.v = Vec3(flight_.speed, 0.0, 0.0);
    return state;
  }

  FeatureFrame look(UTime at) {
    const StereoSpec spec;
    const double t = seconds(at), focal = spec.focal_px();
    std::vector<Box> boxes;
    for (const WorldObstacle& obstacle : world_.obstacles) boxes.push_back(obstacle.box(t));
    const CameraFrame camera(spec, state_at(t), Vec3::Zero(), boxes);
    const double grazing = spec.grazing_deg * std::numbers::pi / 180.0;
    const auto landmarks = field_->around(camera.eye(), spec.range_m, grazing, t);
    const Eigen::Vector2d centre(0.5 * spec.width, 0.5 * spec.height);
    const Eigen::Quaterniond q(spec.camera_to_body());
    FeatureFrame frame;
    frame.at = at;
    frame.q_BC = {q.w(), q.x(), q.y(), q.z()};
    frame.baseline_m = spec.baseline_m;
    frame.sigma = 1.0 / focal;
    for (const SimulatedTrack& track : tracker_.observe(camera, landmarks)) {
      const Eigen::Vector2d right = track.in_right ? track.right : centre;
      frame.features.push_back({track.id, (track.left - centre) / focal, (right - centre) / focal, track.in_right});
    }
    return frame;
  }

  /// The pose 15 ms after a frame.
  [[nodiscard]] Odometry odometry_after(UTime at) const {
    Odometry odometry;
    odometry.at = at + Duration{15'000};
    odometry.state = EstimatorState::Tracking;
    const InertialState state = state_at(seconds(odometry.at));
    odometry.p_OB = state.p;
    odometry.v_OB = state.v;
    for (int k = 0; k < 3; ++k) odometry.pose_covariance[idx(7 * k)] = flight_.pose_error * flight_.pose_error;
    return odometry;
  }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  const Flight& flight_;
  World world_;
  std::optional<LandmarkField> field_;
  TrackSimulator tracker_;
};

Seen fly(const Flight& flight) {
  SimulatedCamera camera(flight);
  const MapProducts map(map_of(flight), config_of(flight));
  Seen seen;
  for (std::int64_t us = 0; static_cast<double>(us) < flight.duration * 1e6; us += kFramePeriod) {
    const PredictionProducts predictions(tracks_at(camera.world(), UTime{us}, flight.knows_movers));
    PathObstacles obstacles;
    for (const Track& track : predictions.set.tracks) {
      if (track.kind == TrackKind::Static) obstacles.fixed.push_back(track.bounds(UTime{us}, UTime{us}));
    }
    seen.watch.add(camera.look(UTime{us}));
    for (auto& line : seen.watch.add(camera.odometry_after(UTime{us}), map, &predictions, obstacles))
      seen.lines.push_back(std::move(line));
  }
  seen.in_force = seen.watch.densities_for(map);
  return seen;
}

/// How many times one is as large as the other, at least 1.
double factor(double a, double b) { return std::exp(std::abs(std::log(a / b))); }

TEST(DensityWatch, FindsTheTruthWhereALabelIsWrong) {
  struct Case {
    const char* name;
    double promised, truth;
  };
  for (const Case& c : {Case{"water", 0.03, 4.0}, Case{"water", 0.03, 1.0}, Case{"snow", 1.0, 4.0}}) {
    for (int seed = 1; seed <= support::at_effort(50); ++seed) {
      Flight flight;
      flight.class_name = c.name;
      flight.promised = c.promised;
      flight.truth = c.truth;
      flight.duration = 8.0;
      flight.seed = static_cast<std::uint64_t>(seed);
      const Seen seen = fly(flight);
      std::printf("%s %.2f, truly %.2f: %.2f as seen; ground %.2f\n", c.name, c.promised, c.truth, seen.of(1),
                  seen.of(kOpenGround));
      EXPECT_LE(factor(seen.of(1), c.truth), 1.5) << c.name << " " << c.promised << " " << c.truth;
      EXPECT_LE(factor(seen.of(kOpenGround), 1.0), 1.5);
    }
  }
}

TEST(DensityWatch, LowersARegionThatHasNoTexture) {
  Flight flight;
  flight.class_name = "texture";
  flight.label = VoxelLabel::Attractive;
  flight.promised = 8.0;
  flight.truth = 0.05;
  flight.duration = 10.0;
  const Seen seen = fly(flight);
  EXPECT_LT(seen.of(1), 1.0);
  ASSERT_FALSE(seen.lines.empty());
  EXPECT_EQ(seen.lines[0].rfind("class texture: 8 landmarks/m² by its label, ", 0), 0u) << seen.lines[0];
}

TEST(DensityWatch, LeavesTrueLabelsAsTheyAre) {
  struct Case {
    const char* name;
    double density;
    VoxelLabel label;
  };
  for (const Case& c : {Case{"water", 0.03, VoxelLabel::Repulsive}, Case{"texture", 8.0, VoxelLabel::Attractive}}) {
    for (int seed = 1; seed <= support::at_effort(50); ++seed) {
      Flight flight;
      flight.class_name = c.name;
      flight.label = c.label;
      flight.promised = flight.truth = c.density;
      flight.seed = static_cast<std::uint64_t>(seed);
      const Seen seen = fly(flight);
      std::printf("%s %.2f: %.3f as seen; ground %.2f\n", c.name, c.density, seen.of(1), seen.of(kOpenGround));
      const double blur = LabelDensities::kBlur;
      EXPECT_LE(factor(seen.of(1) + blur, c.density + blur), 1.5) << c.name;
      EXPECT_LE(factor(seen.of(kOpenGround), 1.0), 1.5);
    }
  }
}

/// Ten boxes that pass in front of the camera, full of landmarks.
std::vector<ObstacleSpec> swarm() {
  std::vector<ObstacleSpec> movers;
  for (int k = 0; k < 10; ++k) {
    WaypointMotion motion;
    motion.points = {{0.0, Vec3(4.0 + k, -3.0 + 0.6 * k, 0.5)}, {12.0, Vec3(52.0 + k, -3.0 + 0.6 * k, 0.5)}};
    movers.push_back({"", Vec3::Zero(), Vec3::Constant(0.5), motion});
  }
  return movers;
}

TEST(DensityWatch, DoesNotCountMovers) {
  for (const bool knows_movers : {true, false}) {
    Flight flight;
    flight.knows_movers = knows_movers;
    const double alone = fly(flight).of(1);
    flight.obstacles = swarm();
    const Seen seen = fly(flight);
    std::printf("known movers %d: water %.3f, without movers %.3f; ground %.2f\n", knows_movers, seen.of(1), alone,
                seen.of(kOpenGround));
    EXPECT_LT(seen.of(1), knows_movers ? 0.1 : 0.3) << "they have 8 landmarks/m², and fill the view";
  }
}

TEST(DensityWatch, CountsObstaclesAtRest) {
  Flight flight;
  for (int k = 0; k < 24; ++k)
    flight.obstacles.push_back(
        {"", Vec3(4.0 + 2.0 * k, k % 2 == 0 ? 2.5 : -2.5, 1.0), Vec3(0.6, 0.6, 1.0), StaticMotion{}});
  for (const double promised : {1.0, 4.0}) {
    flight.promised_obstacles = promised;
    const Seen seen = fly(flight);
    std::printf("obstacles %.1f, truly 4.0: %.2f as seen\n", promised, seen.of(kObstacles));
    EXPECT_LE(factor(seen.of(kObstacles), 4.0), 1.5);
  }
}

TEST(DensityWatch, UsesNoFrameWithoutAGoodPose) {
  Flight flight;
  flight.duration = 0.1;
  SimulatedCamera camera(flight);
  const MapProducts map(map_of(flight), config_of(flight));
  const PredictionProducts predictions(tracks_at(camera.world(), UTime{0}, true));
  const FeatureFrame frame = camera.look(UTime{0});
  const auto used_with = [&](const auto& change) {
    DensityWatch watch;
    FeatureFrame seen = frame;
    Odometry odometry = camera.odometry_after(UTime{0});
    change(seen, odometry);
    watch.add(seen);
    (void)watch.add(odometry, map, &predictions, {});
    return watch.used();
  };
  EXPECT_EQ(used_with([](auto&, auto&) {}), 1);
  EXPECT_EQ(used_with([](auto& f, auto&) { f.features.clear(); }), 0) << "a covered camera";
  EXPECT_EQ(used_with([](auto&, auto& o) { o.state = EstimatorState::Blind; }), 0);
  EXPECT_EQ(used_with([](auto&, auto& o) { o.at = UTime{100'001}; }), 0) << "too late";
  EXPECT_EQ(used_with([](auto& f, auto&) { f.at = UTime{20'000}; }), 0) << "its pose is to come";
  EXPECT_EQ(used_with([](auto&, auto& o) { o.pose_covariance[0] = 0.25; }), 0) << "1.7 m of error";
  EXPECT_EQ(used_with([](auto& f, auto& o) { f.at.us += 600'000, o.at.us += 600'000; }), 0) << "old predictions";
}

TEST(DensityWatch, IsDeterministicAndForgetsAnotherMap) {
  Flight flight;
  flight.truth = 4.0;
  flight.duration = 6.0;
  const Seen first = fly(flight), second = fly(flight);
  ASSERT_TRUE(first.in_force);
  EXPECT_EQ(first.in_force, second.in_force);
  flight.class_name = "pond";
  EXPECT_FALSE(first.watch.densities_for(MapProducts(map_of(flight), config_of(flight))));
}

/// The way to a goal behind the region, from where the flight ends.
struct Way {
  std::vector<Vec3> path;
  double cost = 0.0;  ///< J by the true densities, m
};

Way way_by(const Flight& flight, const std::optional<SurfaceDensities>& densities) {
  const auto map = std::make_shared<const MapProducts>(map_of(flight), config_of(flight));
  const Vec3 start(flight.speed * flight.duration, 0.0, flight.height);
  // The flight box keeps the vehicle low, so that a way is aside or across.
  GoalFieldKey key{Vec3(70, 0, flight.height),
                   1,
                   0,
                   box_around(Vec3::Zero(), Vec3::Constant(0.1)),
                   Box(Vec3(-10, -22, flight.height - 0.4), Vec3(72, 22, flight.height + 0.4)),
                   5.4};
  const auto field_by = [&](const std::optional<SurfaceDensities>& counted) {
    key.densities = counted;
    return make_goal_field(key, map, {}, start);
  };
  Way way{field_by(densities).path_from(start).value()};
  SurfaceDensities truth = map->surfaces.promised();
  truth.by_class[1] = flight.truth;
  way.cost = priced_cost(way.path, ErrorPrice(field_by(truth).cost().information, 20.0, 5.4));
  return way;
}

TEST(DensityWatch, ShortensTheWayAcrossLilies) {
  Flight flight;
  flight.region = Box(Vec3(10, -6, 0), Vec3(55, 6, 0.5));
  flight.truth = 4.0;
  flight.duration = 2.5;  // it begins to see the water
  const Seen seen = fly(flight);
  ASSERT_TRUE(seen.in_force);
  const Way by_label = way_by(flight, std::nullopt), as_seen = way_by(flight, seen.in_force);
  std::printf("by the label %.2f m, J %.2f m; as seen (%.2f) %.2f m, J %.2f m\n", path_length(by_label.path),
              by_label.cost, seen.in_force->by_class[1], path_length(as_seen.path), as_seen.cost);
  EXPECT_GT(path_length(by_label.path), 60.4);
  EXPECT_LT(path_length(as_seen.path), 60.01) << "straight";
  EXPECT_LT(as_seen.cost, by_label.cost - 0.4);
}

TEST(DensityWatch, LeavesACausewayThatHasNoTexture) {
  Flight flight;
  flight.class_name = "texture";
  flight.label = VoxelLabel::Attractive;
  flight.region = Box(Vec3(10, -6, 0), Vec3(55, 6, 0.5));
  flight.promised = 8.0;
  flight.truth = 0.03;
  flight.duration = 5.0;
  const Seen seen = fly(flight);
  ASSERT_TRUE(seen.in_force);
  const Way by_label = way_by(flight, std::nullopt), as_seen = way_by(flight, seen.in_force);
  std::printf("by the label %.2f m, J %.2f m; as seen (%.2f) %.2f m, J %.2f m\n", path_length(by_label.path),
              by_label.cost, seen.in_force->by_class[1], path_length(as_seen.path), as_seen.cost);
  EXPECT_LT(as_seen.cost, by_label.cost - 0.4);
}

}  // namespace
}  // namespace tern
