#include "tests/support/generators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/digest.h"
#include "core/wire/message_limits.h"
#include "core/world/vehicle_status.h"
#include "tests/support/generator_parts.h"
#include "tests/support/random_shares.h"
#include "tests/support/random_splines.h"

namespace tern::support {
namespace {

ChannelCounters counters(Rng& rng) {
  ChannelCounters c;
  for (std::int64_t* x : {&c.sent, &c.received, &c.lost, &c.late}) *x = integer(rng, 0, kMaxCounter);
  for (std::int64_t& x : c.rejected) x = integer(rng, 0, kMaxCounter);
  return c;
}

/// A trajectory that ends at rest, with derivatives that a sample may have.
TimedSpline resting_spline(Rng& rng, int control_points) {
  TimedSpline spline;
  spline.start = time(rng);
  spline.interval = {integer(rng, 100'000, 2'000'000)};
  spline.control_points = random_control_points(rng, control_points - 3);
  spline.control_points.rightCols<3>().colwise() = Vec3(spline.control_points.col(control_points - 1));
  return spline;
}

CertificatePlane plane(Rng& rng, int intervals) {
  CertificatePlane p;
  p.track = integer(rng, -1 - kMaxVoxels, kMaxCounter);
  p.interval = static_cast<std::int16_t>(random_integer(rng, 0, intervals - 1));
  p.parts = static_cast<std::int8_t>(1 << random_integer(rng, 0, 2));
  p.part = static_cast<std::int8_t>(random_integer(rng, 0, p.parts - 1));
  p.plane.n = (random_vector(rng, 1.0) + Vec3(2.0, 0.0, 0.0)).normalized();
  p.plane.d = number(rng, -1e7, 1e7);
  return p;
}

double measure(Rng& rng, double lo, double hi) {
  return rng.uniform() < 0.2 ? std::numeric_limits<double>::quiet_NaN() : number(rng, lo, hi);
}

}  // namespace

Track random_track(Rng& rng, std::int64_t id, int pieces) {
  Track track;
  track.id = id;
  track.kind = pieces == 1 && flag(rng) ? TrackKind::Static : enumerator(rng, TrackKind::Estimated);
  if (track.kind == TrackKind::Static && pieces > 1) track.kind = TrackKind::Estimated;
  track.half_extents = extents(rng);
  track.top_speed = number(rng, 0.0, kMaxSpeed);
  track.motion.start = time(rng);
  for (int k = 0; k < pieces; ++k) {
    CubicPiece piece;
    piece.duration = {integer(rng, 1, kMaxSpan.us)};
    if (track.kind != TrackKind::Static) {
      piece.coefficients.col(0) = vec3(rng, -kMaxJerk, kMaxJerk);
      piece.coefficients.col(1) = vec3(rng, -kMaxAcceleration, kMaxAcceleration);
      piece.coefficients.col(2) = vec3(rng, -kMaxSpeed, kMaxSpeed);
    }
    piece.coefficients.col(3) = position(rng);
    track.motion.pieces.push_back(piece);
    track.alpha.push_back(extents(rng));
    if (track.kind == TrackKind::Estimated) track.shares.push_back(random_shares(rng));
  }
  return track;
}

template <>
UavState random_message(Rng& rng, Fill) {
  return {header(rng), time(rng), motion(rng), number(rng, -std::numbers::pi, std::numbers::pi)};
}

template <>
Goal random_message(Rng& rng, Fill) {
  return {header(rng), integer(rng, 1, kMaxGoalId), enumerator(rng, GoalMode::Stop), position(rng)};
}

template <>
SpeedLimit random_message(Rng& rng, Fill) {
  const auto limit = [&rng] { return number(rng, 0.05, kMaxSpeedLimit); };
  return {header(rng), integer(rng, 1, kMaxGoalId), {limit(), limit(), limit()}};
}

template <>
ObservationSet random_message(Rng& rng, Fill fill) {
  ObservationSet set;
  set.header = header(rng);
  set.at = time(rng);
  set.sensor_id = random_integer(rng, 0, 1000);
  set.range_m = number(rng, 0.0, kMaxCoordinate);
  set.sensor_position = position(rng);
  for (const std::int64_t id : different_ids(rng, count(rng, fill, 0, kMaxDetections))) {
    set.detections.push_back({position(rng), extents(rng), vec3(rng, 0.0, 1e12), flag(rng) ? id : kNoTrackId});
  }
  return set;
}

template <>
CloudScan random_message(Rng& rng, Fill fill) {
  CloudScan scan;
  scan.header = header(rng);
  scan.at = time(rng);
  scan.sensor_id = random_integer(rng, 0, 1000);
  scan.range_m = number(rng, 0.0, kMaxCoordinate);
  scan.sensor_position = position(rng);
  scan.has_classes = flag(rng);
  scan.points.resize(static_cast<std::size_t>(count(rng, fill, 0, kMaxCloudPointsPerMessage)));
  for (CloudPoint& point : scan.points) {
    for (int i = 0; i < 3; ++i) point.position[i] = static_cast<float>(measure(rng, -1e30, 1e30));
    point.class_number = static_cast<std::uint8_t>(random_integer(rng, 0, 255));
  }
  return scan;
}

template <>
DepthImage random_message(Rng& rng, Fill fill) {
  DepthImage image;
  image.header = header(rng);
  image.at = time(rng);
  image.sensor_id = random_integer(rng, 0, 1000);
  image.range_m = number(rng, 0.0, kMaxCoordinate);
  image.sensor_position = position(rng);
  image.q_WC = quaternion(rng);
  image.fx = positive(rng, kMaxCoordinate);
  image.fy = positive(rng, kMaxCoordinate);
  image.cx = number(rng, -kMaxCoordinate, kMaxCoordinate);
  image.cy = number(rng, -kMaxCoordinate, kMaxCoordinate);
  image.unit_m = positive(rng, 1e3);
  image.width = fill == Fill::Largest ? 160 : random_integer(rng, 1, 200);
  image.first_row = random_integer(rng, 0, 1'000'000);
  const int rows = count(rng, fill, 0, kMaxDepthsPerMessage / image.width);
  for (int i = 0; i < rows * image.width; ++i) {
    image.depths.push_back(static_cast<std::int16_t>(random_integer(rng, -32'768, 32'767)));
  }
  return image;
}

template <>
TrackSet random_message(Rng& rng, Fill fill) {
  TrackSet set;
  set.header = header(rng);
  set.batch = batch(rng);
  set.made_at = time(rng);
  set.confidence = positive(rng, 1.0);
  set.left_out = random_integer(rng, 0, 1000);
  const bool has_axes = fill != Fill::Largest && rng.uniform() < 0.5;  // shares of each axis, not of all
  const int tracks = count(rng, fill, 0, has_axes ? 250 : kMaxTracksPerBatch);
  const int bytes = kMaxMessageBytes - 200 - tracks * (has_axes ? 229 : 197);
  const int spare = std::max(0, std::min(kMaxPiecesPerBatch - tracks, bytes / (has_axes ? 176 : 144)));
  int left = fill == Fill::Largest ? 0 : random_integer(rng, 0, spare);
  for (const std::int64_t id : different_ids(rng, tracks)) {
    const int more = random_integer(rng, 0, std::min(left, 12));
    left -= more;
    Track& track = set.tracks.emplace_back(random_track(rng, id, 1 + more));
    for (AlphaShares& shares : track.shares) {
      for (auto& of : shares) of = has_axes ? of : std::array<float, 3>{of[0], of[0], of[0]};
    }
  }
  return set;
}

template <>
MapChunk random_message(Rng& rng, Fill fill) {
  MapChunk chunk;
  chunk.header = header(rng);
  chunk.version = digest(text(rng, 8));
  chunk.grid.resolution = number(rng, 0.01, 1.0);
  chunk.grid.origin = random_vector(rng, 1000.0);
  chunk.grid.size = {random_integer(rng, 1, 500), random_integer(rng, 1, 500), random_integer(rng, 1, 100)};
  chunk.count = random_integer(rng, 1, kMaxMapChunks);
  chunk.index = random_integer(rng, 0, chunk.count - 1);
  const int classes = count(rng, fill, 0, kMaxMapClasses);
  for (int i = 0; i < classes; ++i) chunk.class_names.push_back(text(rng, i == 0 ? 0 : random_integer(rng, 1, 32)));
  if (fill == Fill::Largest) chunk.class_names.back() += text(rng, 32);
  const std::int64_t voxels = chunk.grid.voxels();
  chunk.first_voxel = fill == Fill::Largest ? 0 : integer(rng, 0, voxels);
  if (fill == Fill::Largest) chunk.grid.size = {500, 500, 100};
  const int wanted = count(rng, fill, 0, kMaxRunsPerChunk);
  std::int64_t left = chunk.grid.voxels() - chunk.first_voxel;
  for (int i = 0; i < wanted && left > 0; ++i) {
    const auto length = static_cast<std::int32_t>(integer(rng, 1, std::min<std::int64_t>(left, 3000)));
    left -= length;
    chunk.runs.push_back({enumerator(rng, VoxelLabel::Repulsive),
                          static_cast<std::uint8_t>(random_integer(rng, 0, std::max(0, classes - 1))), length});
  }
  return chunk;
}

template <>
HorizonRequest random_message(Rng& rng, Fill fill) {
  HorizonRequest request;
  request.header = header(rng);
  request.id = integer(rng, 1, kMaxCounter);
  request.committed = resting_spline(rng, count(rng, fill, kMinControlPoints, kMaxControlPoints));
  request.committed.start.us = std::clamp(request.committed.start.us, -kMaxTimeUs + 10'000, kMaxTimeUs - 200'000'000);
  request.t_s = request.committed.start + Duration{integer(rng, 0, 130'000'000)};
  request.deadline = request.t_s - kDeadlineLead - Duration{random_integer(rng, 0, 1000)};
  request.start = request.committed.sample(request.t_s);
  request.limits.v_max = vec3(rng, kMinLimit, kMaxSpeedLimit);
  request.limits.a_max = vec3(rng, kMinLimit, kMaxAccelerationLimit);
  request.limits.j_max =
      flag(rng) ? vec3(rng, kMinLimit, kMaxJerk) : Vec3::Constant(std::numeric_limits<double>::infinity());
  if (flag(rng)) {
    const auto within = [&rng](const Range& range) { return number(rng, range.low, range.high); };
    request.limits.dynamics = Dynamics{within(Dynamics::kThrustMin), within(Dynamics::kThrustMax),
                                       within(Dynamics::kTilt), within(Dynamics::kBodyRate)};
  }
  request.body.radius = number(rng, 0.0, kMaxBodyExtent);
  request.body.vertices = points(rng, count(rng, fill, 1, kMaxBodyVertices), kMaxBodyExtent);
  const Vec3 a = position(rng);
  const Vec3 b = position(rng);
  request.flight_box = Box(a.cwiseMin(b), a.cwiseMax(b));
  request.tube = vec3(rng, 0.0, kMaxBodyExtent);
  return request;
}

template <>
Plan random_message(Rng& rng, Fill fill) {
  Plan plan;
  plan.header = header(rng);
  plan.request_id = integer(rng, 1, kMaxCounter);
  plan.outcome = enumerator(rng, PlanOutcome::NoPlan);
  plan.reason = enumerator(rng, PlanReason::AtGoal);
  const int n = count(rng, fill, kMinControlPoints, kMaxControlPoints);
  plan.trajectory = {time(rng), interval(rng), points(rng, n, kMaxCoordinate)};
  plan.hold = {integer(rng, 0, kMaxSpan.us)};
  plan.confidence = rng.uniform();
  plan.level = random_integer(rng, 0, kLevels - 1);
  if (flag(rng)) plan.confidence = 0.0, plan.level = kLevels - 1, plan.alpha_scale = rng.uniform();
  plan.sure_for = {integer(rng, plan.confidence > 0.0 ? 1 : 0, kMaxSpan.us)};
  plan.relaxed = flag(rng);
  plan.local_goal = position(rng);
  plan.sphere_radius = number(rng, 0.0, kMaxCoordinate);
  plan.cost = {number(rng, 0.0, 1e9), number(rng, 0.0, 1e300), number(rng, -1e300, 1e300), number(rng, -1e9, 1e9),
               number(rng, -1e9, 1e9)};
  plan.inputs = {name(rng),
                 name(rng),
                 name(rng),
                 integer(rng, 0, kMaxCounter),
                 random_integer(rng, 0, 1000),
                 digest(text(rng, 8)),
                 digest(text(rng, 8)),
                 digest(text(rng, 8)),
                 {digest(text(rng, 8)), integer(rng, 0, kMaxCounter), integer(rng, 0, kMaxCounter),
                  digest(text(rng, 8)), name(rng)}};
  const int planes = count(rng, fill, 0, kMaxCertificatePlanes);
  for (int i = 0; i < planes; ++i) plan.certificate.push_back(plane(rng, n - 3));
  const int cuts = count(rng, fill, 0, kMaxBudgetCuts);
  for (int i = 0; i < cuts; ++i) {
    plan.cuts.push_back({enumerator(rng, Phase::Room), random_integer(rng, 0, kMaxAttempts - 1),
                         enumerator(rng, Stage::Check), integer(rng, 0, kMaxCounter)});
  }
  if (cuts < kMaxBudgetCuts && rng.uniform() < 0.3) plan.standing = integer(rng, 0, kMaxCounter);
  return plan;
}

template <>
SearchView random_message(Rng& rng, Fill fill) {
  SearchView view;
  view.header = header(rng);
  view.request_id = integer(rng, 1, kMaxCounter);
  view.left_out = static_cast<std::int32_t>(integer(rng, 0, std::numeric_limits<std::int32_t>::max()));
  const int nodes = count(rng, fill, 0, kMaxSearchNodes);
  for (int k = 0; k < nodes; ++k) {
    view.nodes.push_back({position(rng), static_cast<std::int32_t>(integer(rng, -1, k - 1))});
  }
  return view;
}

template <>
TrackBounds random_message(Rng& rng, Fill fill) {
  TrackBounds of;
  of.header = header(rng);
  of.at = time(rng);
  of.confidence = number(rng, std::numeric_limits<double>::min(), 1.0);
  of.left_out = static_cast<std::int32_t>(integer(rng, 0, std::numeric_limits<std::int32_t>::max()));
  const int bounds = count(rng, fill, 0, kMaxTrackBounds);
  for (int k = 0; k < bounds; ++k) {
    TrackBound& bound = of.bounds.emplace_back();
    bound.id = integer(rng, 0, kMaxCounter);
    bound.kind = enumerator(rng, MotionKind::Resting);
    bound.ruled_by = enumerator(rng, BoundRule::Reach);
    for (double* x : {&bound.ahead_s, &bound.model, &bound.measured, &bound.promised, &bound.evidence}) {
      *x = number(rng, 0.0, kMaxCoordinate);
    }
  }
  return of;
}

template <>
PlanTiming random_message(Rng& rng, Fill) {
  PlanTiming t;
  t.header = header(rng);
  t.request_id = integer(rng, 1, kMaxCounter);
  for (double* x : {&t.total_ms, &t.first_answer_ms, &t.cpu_ms}) *x = number(rng, 0.0, 1e9);
  for (double& x : t.stage_ms) x = number(rng, 0.0, 1e9);
  for (std::int64_t* x :
       {&t.expansions, &t.hulls, &t.pairs_by_index, &t.pairs_by_box, &t.pairs_by_instant, &t.pairs_by_cache,
        &t.pairs_by_plane, &t.pairs_by_lp, &t.solver_calls, &t.solver_iterations, &t.peak_rss_kb}) {
    *x = integer(rng, 0, kMaxCounter);
  }
  t.from_watchdog = flag(rng);
  return t;
}

template <>
Heartbeat random_message(Rng& rng, Fill fill) {
  Heartbeat heartbeat;
  heartbeat.header = header(rng);
  heartbeat.process = text(rng, count(rng, fill, 1, kMaxProcessText));
  heartbeat.build_id = text(rng, count(rng, fill, 0, kMaxBuildIdText));
  heartbeat.state = enumerator(rng, ProcessState::Failed);
  heartbeat.waiting_for = text(rng, count(rng, fill, 0, kMaxWaitingText));
  const auto channels = static_cast<std::size_t>(count(rng, fill, 0, kMaxHeartbeatChannels));
  while (heartbeat.channels.size() < channels) {
    heartbeat.channels.emplace(text(rng, count(rng, fill, 1, kMaxChannelName)), counters(rng));
  }
  const int echoes = count(rng, fill, 0, kMaxClockEchoes);
  for (std::int64_t epoch_us = 0; std::ssize(heartbeat.echoes) < echoes;) {
    epoch_us += integer(rng, 1, kMaxTimeUs / kMaxClockEchoes);
    heartbeat.echoes.push_back({epoch_us, time(rng), time(rng)});
  }
  return heartbeat;
}

template <>
ConfigurationReport random_message(Rng& rng, Fill fill) {
  ConfigurationReport report;
  report.header = header(rng);
  report.process = text(rng, count(rng, fill, 1, kMaxProcessText));
  report.build_id = text(rng, count(rng, fill, 0, kMaxBuildIdText));
  report.platform = text(rng, count(rng, fill, 0, kMaxPlatformText));
  report.yaml = text(rng, count(rng, fill, 0, kMaxYamlText));
  report.hash = digest(report.yaml);
  return report;
}

template <>
ObstacleTruth random_message(Rng& rng, Fill fill) {
  ObstacleTruth truth;
  truth.header = header(rng);
  truth.batch = batch(rng);
  truth.at = time(rng);
  truth.left_out = random_integer(rng, 0, 1000);
  for (const std::int64_t id : different_ids(rng, count(rng, fill, 0, kMaxObstaclesPerBatch))) {
    truth.obstacles.push_back({id, position(rng), vec3(rng, -kMaxSpeed, kMaxSpeed), extents(rng), flag(rng)});
  }
  return truth;
}

template <>
VehicleStatus random_message(Rng& rng, Fill fill) {
  VehicleStatus status;
  status.header = header(rng);
  status.at = time(rng);
  status.following = fill == Fill::Mixed && flag(rng);
  status.armed = status.following || flag(rng);
  status.landed = flag(rng);
  status.mode = text(rng, count(rng, fill, 0, kMaxModeText));
  if (!status.following) status.why_not = text(rng, count(rng, fill, 1, kMaxWhyText));
  if (flag(rng)) status.battery = number(rng, 0.0, 1.0);
  status.estimator = enumerator(rng, EstimatorHealth::Lost);
  status.position_sigma = extents(rng);
  status.resets = integer(rng, 0, kMaxCounter);
  return status;
}

template <>
FlightResult random_message(Rng& rng, Fill fill) {
  FlightResult result;
  result.header = header(rng);
  result.outcome = enumerator(rng, FlightOutcome::Failed);
  result.detail = text(rng, count(rng, fill, 0, kMaxDetailText));
  result.flight_time_s = measure(rng, 0.0, 1e9);
  result.first_entry_s = measure(rng, 0.0, 1e9);
  result.path_length_m = measure(rng, 0.0, 1e9);
  result.mean_speed_mps = measure(rng, 0.0, kMaxSpeed);
  result.top_speed_mps = measure(rng, 0.0, kMaxSpeed);
  result.min_clearance_m = measure(rng, -1e7, 1e7);
  result.min_map_clearance_m = measure(rng, -1e7, 1e7);
  result.jerk_integral = measure(rng, 0.0, 1e300);
  result.stops = integer(rng, 0, kMaxCounter);
  result.limit_violations = integer(rng, 0, kMaxCounter);
  result.contacts_moving = integer(rng, 0, kMaxCounter);
  result.contacts_at_rest = integer(rng, 0, kMaxCounter);
  result.obstacles = integer(rng, 0, kMaxCounter);
  result.obstacles_left_out = integer(rng, 0, kMaxCounter);
  const int regions = count(rng, fill, 0, kMaxExposures);
  for (int i = 0; i < regions; ++i) {
    result.exposure.push_back({text(rng, fill == Fill::Largest ? 64 : random_integer(rng, 0, 64)),
                               number(rng, 0.0, 1e9), number(rng, 0.0, 1e9), number(rng, 0.0, 1e9),
                               number(rng, 0.0, 1e9)});
  }
  return result;
}

}  // namespace tern::support
