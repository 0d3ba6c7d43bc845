#include "tests/viewer/known_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/digest.h"

namespace tern::support {
namespace {

constexpr double kMoverSlowness = 1.5;   // s
constexpr double kMoverAmplitude = 1.0;  // m

Vec3 mover_position(int k, double t) {
  return {2.0 * k, -3.0 + kMoverAmplitude * std::sin(t / kMoverSlowness + k), 1.0};
}
Vec3 mover_velocity(int k, double t) {
  return {0.0, kMoverAmplitude / kMoverSlowness * std::cos(t / kMoverSlowness + k), 0.0};
}

/// From rest to rest.
TimedSpline straight(const Vec3& from, const Vec3& way, UTime start) {
  TimedSpline spline{start, Duration{200'000}, Points(3, 9)};
  constexpr double kShares[] = {0.0, 0.0, 0.0, 0.2, 0.5, 0.8, 1.0, 1.0, 1.0};
  for (int k = 0; k < 9; ++k) spline.control_points.col(k) = from + kShares[k] * way;
  return spline;
}

}  // namespace

KnownScene::KnownScene(UTime start, double course) : start_(start), ahead_(std::cos(course), std::sin(course), 0.0) {}

UavState KnownScene::state(UTime now) const {
  const double t = std::clamp((now - start_).seconds(), 0.0, kKnownSeconds);
  UavState state;
  state.at = now;
  state.motion.p = Vec3(0.0, 0.0, 1.0) + kKnownSpeed * t * ahead_;
  state.motion.v = t < kKnownSeconds ? Vec3(kKnownSpeed * ahead_) : Vec3::Zero();
  return state;
}

ObstacleTruth KnownScene::truth(UTime now) const {
  ObstacleTruth truth;
  truth.at = now;
  truth.batch = {std::max<std::int64_t>((now - start_).us, 0) + 1, 0, 1};
  for (int k = 0; k < kKnownPillars; ++k) {
    truth.obstacles.push_back({k, Vec3(k, 3.0, 1.0), Vec3::Zero(), Vec3(0.2, 0.2, 1.0), false});
  }
  const double t = (now - start_).seconds();
  for (int k = 0; k < kKnownMovers; ++k) {
    truth.obstacles.push_back(
        {kKnownPillars + k, mover_position(k, t), mover_velocity(k, t), Vec3::Constant(0.4), true});
  }
  return truth;
}

ObservationSet KnownScene::observations(UTime now) const {
  ObservationSet set;
  set.at = now;
  for (const TrueObstacle& o : truth(now).obstacles) {
    if (o.moves) set.detections.push_back({o.position, o.half_extents, Vec3::Constant(0.01), o.id});
  }
  return set;
}

SightingSet KnownScene::sightings(UTime now) const {
  SightingSet set;
  set.at = now;
  SensorView& view = set.view;
  view.sensor_position = state(now).motion.p;
  const Eigen::Quaterniond q =
      Eigen::AngleAxisd(std::atan2(ahead_.y(), ahead_.x()), Vec3::UnitZ()) * Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  view.q_WC = {q.w(), q.x(), q.y(), q.z()};
  view.left = view.right = 0.7;
  view.up = view.down = 0.5;
  view.range_m = 10.0;
  view.rows = 3;
  view.columns = 4;
  view.depths = {kFarDepth, kFarDepth, kFarDepth, kFarDepth, 500, 400, kBlindDepth, kFarDepth, 200, 200, 200, 200};
  Sighting pillar;
  pillar.lower = Vec3(9.8, 2.8, 0.0);
  pillar.upper = Vec3(10.0, 3.2, 2.0);
  pillar.bounds = {BoundSight::Face,     BoundSight::Unseen,   BoundSight::Whole,
                   BoundSight::Occluded, BoundSight::Touching, BoundSight::Cut};
  set.sightings.push_back(pillar);
  return set;
}

TrackSet KnownScene::predictions(UTime now) const {
  TrackSet set;
  set.made_at = now;
  const ObstacleTruth world = truth(now);
  set.batch = world.batch;
  for (const TrueObstacle& o : world.obstacles) {
    CubicPiece piece{Duration{3'500'000}, PowerCubic::Zero()};
    piece.coefficients.col(2) = o.velocity;
    piece.coefficients.col(3) = o.position;
    Track track{o.id, o.moves ? TrackKind::Declared : TrackKind::Static, o.half_extents, {now, {piece}}, {}, {}, 1.0};
    track.alpha = {o.moves ? Vec3::Constant(0.2) : Vec3::Zero()};
    set.tracks.push_back(track);
  }
  return set;
}

HorizonRequest KnownScene::request(UTime now, std::int64_t id) const {
  HorizonRequest request;
  request.header.utime = now;
  request.id = id;
  request.t_s = now + Duration{75'000};
  request.deadline = now + Duration{70'000};
  request.committed = straight(state(now).motion.p, 4.0 * ahead_, request.t_s);
  request.start = request.committed.sample(request.t_s);
  request.flight_box = Box(Vec3(-5.0, -5.0, 0.0), Vec3(5.0, 5.0, 4.0));
  request.flight_box.extend(Vec3(40.0 * ahead_));
  return request;
}

Plan KnownScene::plan(const HorizonRequest& request) const {
  Plan plan;
  plan.request_id = request.id;
  plan.outcome = PlanOutcome::Optimized;
  plan.trajectory = request.committed;
  plan.hold = Duration{1'000'000};
  plan.confidence = 0.9;
  plan.level = 2;
  plan.sure_for = Duration{800'000};
  plan.local_goal = request.start.p + 4.0 * ahead_;
  plan.sphere_radius = 4.0;
  plan.certificate.push_back({0, 2, 0, 1, {Vec3(0.0, 1.0, 0.0), -1.0}});
  return plan;
}

PlanTiming KnownScene::timing(std::int64_t request_id) const {
  PlanTiming timing;
  timing.request_id = request_id;
  timing.total_ms = 12.5;
  timing.expansions = 42;
  return timing;
}

SearchView KnownScene::search(std::int64_t request_id) const {
  SearchView view;
  view.request_id = request_id;
  view.nodes = {{Vec3(0.0, 0.0, 1.0), -1}, {Vec3(1.0, 0.0, 1.0), 0}, {Vec3(1.0, 1.0, 1.0), 0}};
  return view;
}

Goal KnownScene::goal() const { return {{}, 1, GoalMode::Go, Vec3(0.0, 0.0, 1.0) + 20.0 * ahead_}; }

Heartbeat KnownScene::heartbeat() const {
  Heartbeat heartbeat;
  heartbeat.process = "tern-scene";
  heartbeat.state = ProcessState::Ready;
  return heartbeat;
}

ConfigurationReport KnownScene::configuration() const {
  ConfigurationReport report;
  report.process = "tern-scene";
  report.yaml = "world:\n  obstacles:\n";
  for (int k = 0; k < 10; ++k) report.yaml += "    -\n      name: \"\"\n";
  report.yaml += "    -\n      name: gate\n";
  report.hash = digest(report.yaml);
  return report;
}

VoxelMap KnownScene::map() const {
  VoxelMap map;
  map.grid = {Vec3(6.0, -2.0, 0.0), 0.5, Eigen::Vector3i(8, 8, 4)};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {""};
  for (int x = 2; x < 6; ++x) {
    for (int z = 0; z < 4; ++z) {
      for (const auto& [y, label] : {std::pair(7, VoxelLabel::Attractive), std::pair(0, VoxelLabel::Repulsive)}) {
        map.labels[static_cast<std::size_t>(map.grid.index({x, y, z}))] = label;
      }
    }
  }
  map.version = map.compute_version();
  return map;
}

}  // namespace tern::support
