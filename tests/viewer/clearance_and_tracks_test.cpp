// The scene beside the referee: clearances; and detections, tracks and names.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/geometry/box.h"
#include "core/world/body_distance.h"
#include "tests/viewer/known_scene.h"
#include "viewer/bridge/scene.h"
#include "viewer/bridge/scene_json.h"
#include "viewer/bridge/track_ages.h"

namespace tern {
namespace {

using nlohmann::json;

constexpr UTime kStart{1'000'000'000};

UTime at(double seconds) { return kStart + Duration::from_seconds(seconds); }

Body box_body(const Vec3& half) { return {box_corners(box_around(Vec3::Zero(), half)), 0.0}; }

/// A scene with this body at p, and one still obstacle of half-extents 0.5 m about the origin.
Scene scene_of(const Body& body, const Vec3& p) {
  Scene scene;
  UavState state;
  state.at = kStart;
  state.motion.p = p;
  scene.receive(state);
  ObstacleTruth truth;
  truth.at = kStart;
  truth.obstacles = {{7, Vec3::Zero(), Vec3::Zero(), Vec3::Constant(0.5), false}};
  scene.receive(truth);
  HorizonRequest request;
  request.body = body;
  scene.receive(request);
  return scene;
}

TEST(SceneClearance, IsKnownWithTheBody) {
  Scene scene;
  EXPECT_EQ(scene.clearance(), std::nullopt);
  const support::KnownScene known(kStart);
  scene.receive(known.state(kStart));
  scene.receive(known.truth(kStart));
  EXPECT_EQ(scene.clearance(), std::nullopt);
  scene.receive(known.request(kStart, 1));
  const double nearest = std::hypot(2.0 - 0.4, 3.0 - std::sin(1.0) - 0.4);  // mover 1 at (2, −3 + sin 1)
  EXPECT_NEAR(*scene.clearance(), nearest - 0.1, 1e-9);
}

TEST(SceneClearance, OfABoxThatPassesBesideAnObstacleIsTheGapBetweenThem) {
  // The ball around this body has a radius of 0.212 m, so it would overlap the obstacle by 0.099 m.
  const Scene scene = scene_of(box_body({0.1, 0.1, 0.158}), Vec3(0.613, 0.0, 0.0));
  EXPECT_NEAR(*scene.clearance(), 0.013, 1e-12);
  EXPECT_NEAR(*scene.clearance_of(7), 0.013, 1e-12);
  EXPECT_EQ(scene.clearance_of(8), std::nullopt);
  EXPECT_NEAR(*scene_of(box_body({0.1, 0.1, 0.158}), Vec3(0.55, 0.0, 0.0)).clearance(), -0.05, 1e-12);
}

TEST(SceneClearance, FollowsTheBodyOfTheNewestRequest) {
  Scene scene = scene_of(box_body({0.1, 0.1, 0.1}), Vec3(1.0, 0.0, 0.0));
  EXPECT_NEAR(*scene.clearance(), 0.4, 1e-12);
  HorizonRequest request;
  request.body = {Points::Zero(3, 1), 0.3};
  scene.receive(request);
  EXPECT_NEAR(*scene.clearance(), 0.2, 1e-12);
}

TEST(SceneClearance, IsThatOfTheVehicleAsItReallyIs) {
  Scene scene = scene_of({Points::Zero(3, 1), 0.1}, Vec3(1.0, 0.0, 0.0));
  UavState truth;
  truth.at = at(-0.02);
  truth.motion.p = Vec3(1.5, 0.0, 0.0);
  truth.motion.v = Vec3(-5.0, 0.0, 0.0);
  scene.receive_truth(truth);
  EXPECT_NEAR(*scene.clearance(), 0.8, 1e-9);
  truth.at = at(-2.0);
  scene.receive_truth(truth);
  EXPECT_NEAR(*scene.clearance(), 0.4, 1e-9) << "an old truth is of another place";
}

RC_GTEST_PROP(SceneClearance, IsTheRefereesForBodiesOfAnyShape, ()) {
  const auto metres = rc::gen::map(rc::gen::inRange(-300, 300), [](int cm) { return 0.01 * cm; });
  const auto vector = [&] { return Vec3(*metres, *metres, *metres); };
  Body body{Points(3, *rc::gen::inRange(1, 9)), 0.1 * std::abs(*metres)};
  for (Eigen::Index k = 0; k < body.vertices.cols(); ++k) body.vertices.col(k) = 0.2 * vector();
  Scene scene = scene_of(body, vector());
  ObstacleTruth truth;
  truth.at = kStart;
  const int count = *rc::gen::inRange(1, 12);
  for (int k = 0; k < count; ++k) truth.obstacles.push_back({k, vector(), vector(), vector().cwiseAbs(), true});
  scene.receive(truth);
  const BodyDistance distance(body);
  double nearest = std::numeric_limits<double>::infinity();
  for (const TrueObstacle& o : truth.obstacles) {
    nearest = std::min(nearest, distance(scene.state()->motion.p - o.position, o.half_extents));
  }
  RC_ASSERT(std::abs(*scene.clearance() - nearest) < 1e-12);
}

TEST(Scene, CallsObstaclesByTheirNames) {
  Scene scene = scene_of({Points::Zero(3, 1), 0.1}, Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(json::parse(detail_json(scene, {PickKind::Obstacle, 7, ""}))["title"], "Obstacle 7");
  EXPECT_FALSE(json::parse(truth_json(scene)).contains("names"));
  ConfigurationReport report;
  report.process = "tern-simulator";
  report.yaml =
      "world:\n  generator: paper_corridor\n  count: 6\n  obstacles:\n    -\n      name: \"\"\n    -\n      name: "
      "gate\n";
  scene.receive(report);
  const json detail = json::parse(detail_json(scene, {PickKind::Obstacle, 7, ""}));
  EXPECT_EQ(detail["title"], "Obstacle 7 'gate'");
  EXPECT_NEAR(detail["clearance_m"].get<double>(), 0.4, 1e-9);
  EXPECT_EQ(json::parse(truth_json(scene))["names"], json::parse(R"({"7": "gate"})"));
}

TrackSet set_of(double seconds, const std::vector<std::int64_t>& ids) {
  TrackSet set;
  set.made_at = at(seconds);
  for (const std::int64_t id : ids) {
    Track track;
    track.id = id;
    set.tracks.push_back(track);
  }
  return set;
}

TEST(TrackAges, CountFromTheSetInWhichATrackBegan) {
  TrackAges ages;
  ages.receive(set_of(0.0, {1, 2}));
  ages.receive(set_of(0.1, {1, 2, 3}));
  ages.receive(set_of(0.2, {1, 3}));
  ages.receive(set_of(0.2, {1, 2, 3}));  // no newer set
  ages.receive(set_of(0.3, {1, 2, 3}));
  EXPECT_NEAR(*ages.age_s(1, at(0.3)), 0.3, 1e-9);
  EXPECT_NEAR(*ages.age_s(2, at(0.3)), 0.0, 1e-9) << "it was missing in a set";
  EXPECT_NEAR(*ages.age_s(3, at(0.3)), 0.2, 1e-9);
  EXPECT_NEAR(*ages.age_s(2, at(0.1)), 0.1, 1e-9) << "ages of the past, for a jump in a log";
  EXPECT_EQ(ages.age_s(2, at(0.2)), std::nullopt);
  EXPECT_EQ(ages.age_s(3, at(0.05)), std::nullopt);
  EXPECT_EQ(ages.age_s(9, at(0.3)), std::nullopt);
}

TEST(TrackAges, ForgetThePastBeforeMemoryGrows) {
  TrackAges ages;
  const auto periods = static_cast<int>(TrackAges::kMaxPeriods);
  for (int k = 0; k < periods; ++k) ages.receive(set_of(0.1 * k, {5, 10 + k}));
  EXPECT_NEAR(*ages.age_s(5, at(0.1 * (periods - 1))), 0.1 * (periods - 1), 1e-6);
  EXPECT_EQ(ages.age_s(10, at(0.0)), std::nullopt);
}

TEST(Tracked, HasTheDetectionsOfAllSensorsAndTheMovingTracksWithAlphaAndAge) {
  Scene::Memory memory;
  Scene scene(&memory);
  EXPECT_EQ(tracked_json(scene, memory.ages), "null");
  const support::KnownScene known(kStart);
  scene.receive(known.predictions(kStart));
  TrackSet late = known.predictions(at(0.5));
  for (Track& track : late.tracks) track.motion.start = at(0.55);  ///< the sensor's latency
  scene.receive(late);
  for (const auto& [sensor, seconds] : {std::pair(1, 0.5), std::pair(2, 0.4), std::pair(3, -1.0)}) {
    ObservationSet seen;
    seen.sensor_id = sensor;
    seen.at = at(seconds);
    seen.detections = {{Vec3(sensor, 0.0, 1.0), Vec3::Constant(0.3), Vec3::Zero(), 40 + sensor}};
    scene.receive(seen);
  }
  EXPECT_TRUE(scene.take_change(Topic::Tracked));
  const json told = json::parse(tracked_json(scene, memory.ages));
  EXPECT_EQ(told["detections"]["id"], json::parse("[41, 42]")) << "sensor 3 has been silent";
  EXPECT_EQ(told["detections"]["p"], json::parse("[1, 0, 1, 2, 0, 1]"));
  const json& tracks = told["tracks"];
  ASSERT_EQ(tracks["id"].size(), static_cast<std::size_t>(support::kKnownMovers));
  EXPECT_EQ(tracks["age_s"][0], 0.5);
  for (const json& alpha : tracks["alpha"]) EXPECT_NEAR(alpha.get<double>(), 0.2, 1e-4);
}

}  // namespace
}  // namespace tern
