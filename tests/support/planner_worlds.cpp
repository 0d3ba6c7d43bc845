#include "tests/support/planner_worlds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "core/world/body.h"
#include "planner/problem/tuning.h"
#include "planner/search/axis_reach.h"
#include "tests/support/random_shares.h"
#include "tests/support/random_splines.h"
#include "tests/support/voxel_maps.h"

namespace tern::support {
namespace {

Vec3 random_in(Rng& rng, const Box& box) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = rng.uniform(box.min()[axis], box.max()[axis]);
  return p;
}

Vec3 random_alpha(Rng& rng) {
  return rng.uniform() < 0.2 ? Vec3(Vec3::Zero())
                             : Vec3(rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.1), rng.uniform(0.0, 0.1));
}

/// Oracle of AlphaShare::of.
Vec3 counted(const Track& track, std::size_t piece, const AlphaShare& count) {
  const bool is_lower = count.level > 0 && !track.shares.empty();
  Vec3 least = Vec3::Constant(1e9);
  for (const std::size_t k : {piece, std::min(piece, count.grows_to)}) {
    for (int axis = 0; axis < 3; ++axis) {
      const double share = is_lower ? track.shares[k][idx(count.level) - 1][idx(axis)] : 1.0F;
      least[axis] = std::min(least[axis], count.scale * share * track.alpha[k][axis]);
    }
  }
  return least;
}

Track shell(Rng& rng, std::int64_t id) {
  Track track;
  track.id = id;
  track.half_extents = Vec3(rng.uniform(0.1, 0.6), rng.uniform(0.1, 0.6), rng.uniform(0.1, 0.6));
  track.top_speed = rng.uniform(0.0, 4.0);
  return track;
}

}  // namespace

Track random_mover(Rng& rng, std::int64_t id, const Box& where, UTime from, double seconds) {
  Track track = shell(rng, id);
  const Vec3 centre = random_in(rng, where);
  const Vec3 amplitude(rng.uniform(0.0, 2.0), rng.uniform(0.0, 2.0), rng.uniform(0.0, 1.0));
  const Vec3 rate(rng.uniform(0.2, 3.0), rng.uniform(0.2, 3.0), rng.uniform(0.2, 3.0));
  const Vec3 phase = random_vector(rng, 3.0);
  const int pieces = random_integer(rng, 3, 9);
  const Duration piece{static_cast<std::int64_t>(seconds * 1e6 / pieces)};
  track.motion = hermite_fit(from, piece, pieces, [&](Duration t) {
    MotionSample s;
    for (int axis = 0; axis < 3; ++axis) {
      const double angle = rate[axis] * t.seconds() + phase[axis];
      s.p[axis] = centre[axis] + amplitude[axis] * std::sin(angle);
      s.v[axis] = amplitude[axis] * rate[axis] * std::cos(angle);
    }
    return s;
  });
  for (int k = 0; k < pieces; ++k) track.alpha.push_back(random_alpha(rng));
  return track;
}

Track jumping_mover(Rng& rng, std::int64_t id, const Box& where, UTime from, double seconds) {
  Track track = shell(rng, id);
  track.kind = TrackKind::Estimated;
  track.motion.start = from;
  const int pieces = random_integer(rng, 1, 7);
  for (int k = 0; k < pieces; ++k) {
    CubicPiece piece{Duration{static_cast<std::int64_t>(seconds * 1e6 / pieces) + random_integer(rng, 0, 999)},
                     random_cubic(rng)};
    piece.coefficients.col(3) = random_in(rng, where);
    track.motion.pieces.push_back(piece);
    track.alpha.push_back(random_alpha(rng));
    track.shares.push_back(random_shares(rng));
  }
  return track;
}

Track straight_mover(std::int64_t id, const Vec3& p, const Vec3& v, double half, UTime from, double seconds) {
  Track track;
  track.id = id;
  track.half_extents = Vec3::Constant(half);
  track.top_speed = v.cwiseAbs().maxCoeff();
  CubicPiece piece{Duration::from_seconds(seconds), PowerCubic::Zero()};
  piece.coefficients.col(2) = v;
  piece.coefficients.col(3) = p;
  track.motion = {from, {piece}};
  track.alpha = {Vec3::Zero()};
  return track;
}

Track standing_box(std::int64_t id, const Box& box, UTime from) {
  Track track = straight_mover(id, box.center(), Vec3::Zero(), 0.0, from, 1.0);
  track.kind = TrackKind::Static;
  track.half_extents = 0.5 * box.sizes();
  return track;
}

Body body_of(BodyKind kind) {
  Body body;
  if (kind == BodyKind::Sphere) return body;
  body.radius = 0.0;
  if (kind == BodyKind::BoxShape) {
    body.vertices = box_corners(box_around(Vec3::Zero(), Vec3(0.2, 0.15, 0.1)));
  } else {
    body.vertices.resize(3, 5);
    body.vertices << 0.3, -0.1, -0.1, 0.0, 0.0,  //
        0.0, 0.2, -0.2, 0.0, 0.0,                //
        0.0, 0.0, 0.0, 0.1, -0.05;
  }
  return body;
}

std::vector<PlanningObstacle> obstacles_of(const std::vector<Track>& tracks) {
  std::vector<PlanningObstacle> obstacles;
  for (const Track& track : tracks) {
    obstacles.push_back({track.id, &track, track.bounds(track.motion.start, track.motion.end() + kTrackBoxReach), {}});
  }
  return obstacles;
}

Box promised_box(const Track& track, UTime t, const AlphaShare& count) {
  if (track.kind == TrackKind::Static) {
    return box_around(track.motion.pieces[0].coefficients.col(3), track.half_extents + counted(track, 0, count));
  }
  const UTime inside = std::clamp(t, track.motion.start, track.motion.end());
  const double outside_s = std::abs((t - inside).seconds());
  const Vec3 alpha = counted(track, track.motion.locate(inside).index, count);
  return box_around(track.motion.sample(inside).p,
                    track.half_extents + alpha + Vec3::Constant(track.top_speed * outside_s));
}

double support_of_sweep(const Track& track, const AlphaShare& count, UTime origin, double from, double to,
                        const Vec3& d) {
  double most = -INFINITY;
  const Vec3 reach = d.cwiseAbs();
  const double start = (track.motion.start - origin).seconds();
  double piece_from = start;
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    const CubicPiece& piece = track.motion.pieces[k];
    const double piece_to = piece_from + piece.duration.seconds();
    const double a = std::max(from, piece_from);
    const double b = std::min(to, piece_to);
    if (a <= b) {
      PowerCubic projected = PowerCubic::Zero();
      projected.row(0) = d.transpose() * piece.coefficients;
      const double along = cubic_bounds(projected, a - piece_from, b - piece_from).max().x();
      most = std::max(most, along + reach.dot(track.half_extents + counted(track, k, count)));
    }
    piece_from = piece_to;
  }
  const auto growing = [&](double seconds, const Vec3& p, const Vec3& alpha) {
    const Vec3 half = track.half_extents + alpha + Vec3::Constant(track.top_speed * seconds);
    most = std::max(most, d.dot(p) + reach.dot(half));
  };
  if (to > piece_from)
    growing(to - piece_from, track.motion.sample(track.motion.end()).p, counted(track, track.alpha.size() - 1, count));
  if (from < start) growing(start - from, track.motion.sample(track.motion.start).p, counted(track, 0, count));
  return most;
}

double gap(const Body& body, const Vec3& p, const Box& box) {
  if (body.vertices.cols() == 1) return std::max(0.0, box.exteriorDistance(p + body.vertices.col(0)) - body.radius);
  const Points at = body.vertices.colwise() + p;
  return std::max(0.0, distance(box_corners(box), at) - body.radius);
}

double least_gap(const TimedSpline& trajectory, const Body& body, const std::vector<PlanningObstacle>& obstacles,
                 UTime from, UTime to, Duration step) {
  double least = INFINITY;
  const ClampedSpline spline = trajectory.spline();
  const Vec3 half = body.half_extents();
  for (UTime t = from;; t = std::min(t + step, to)) {
    const Vec3 p = spline.sample((t - trajectory.start).seconds()).p;
    for (const PlanningObstacle& o : obstacles) {
      const Box box = o.track != nullptr ? promised_box(*o.track, t, o.alpha) : o.map_box(o.alpha.scale);
      const double at_least = box.exteriorDistance(box_around(p, half));
      if (at_least < least) least = std::min(least, gap(body, p, box));
    }
    if (t == to) return least;
  }
}

std::optional<Points> random_way_to_rest(Rng& rng, const MotionSample& start, const Limits& limits, int intervals,
                                         double dt) {
  Points q(3, intervals + 3);
  q.leftCols<3>() = start_control_points(start, dt);
  for (int axis = 0; axis < 3; ++axis) {
    const AxisReach reach(intervals, dt, limits.v_max[axis], limits.a_max[axis], limits.j_max[axis]);
    const double eagerness = rng.uniform();
    double v = start.v[axis] + 0.5 * dt * start.a[axis];
    double a = start.a[axis];
    for (int l = 1; l < intervals; ++l) {
      const AxisReach::Interval range = reach.next_velocity(l, v, a);
      if (range.empty()) return std::nullopt;
      const double share = rng.uniform() < eagerness ? 1.0 : rng.uniform();
      const double next = range.low + (range.high - range.low) * share;
      a = (next - v) / dt;
      v = next;
      if (l + 1 < intervals) q(axis, l + 2) = q(axis, l + 1) + v * dt;
    }
  }
  q.rightCols<2>() = q.col(intervals).replicate(1, 2);
  return q;
}

TimedSpline random_trajectory(Rng& rng, const Vec3& p, UTime start, const Limits& limits, int intervals) {
  TimedSpline out;
  out.start = start;
  out.interval = Duration{random_integer(rng, 120'000, 300'000)};
  MotionSample rest;
  rest.p = p;
  out.control_points = *random_way_to_rest(rng, rest, limits, intervals, out.interval.seconds());
  return out;
}

TimedSpline resting_at(const Vec3& p, UTime start) {
  TimedSpline out;
  out.start = start;
  out.control_points = p.replicate(1, 7);
  return out;
}

HorizonRequest request_at(UTime t_s, const TimedSpline& committed) {
  HorizonRequest request;
  request.header.name = {1, 1};
  request.header.utime = t_s - Duration{75'000};
  request.id = 1;
  request.t_s = t_s;
  request.deadline = t_s - Duration{5'000};
  request.committed = committed;
  request.start = committed.sample(t_s);
  request.flight_box = Box(Vec3::Constant(-1e4), Vec3::Constant(1e4));
  return request;
}

PlanningWorld world_of(std::vector<Track> tracks, const Goal& goal, const HorizonRequest& request,
                       const PlannerConfig& config, const VoxelMap& map) {
  TrackSet set;
  set.header.name = {2, 1};
  set.batch.set = 1;
  set.made_at = request.header.utime;
  set.tracks = std::move(tracks);
  PlanningWorld world;
  world.predictions = std::make_shared<const PredictionProducts>(std::move(set));
  const auto products = std::make_shared<const MapProducts>(map, config);
  world.map = products;
  std::vector<Box> statics;
  for (const Track& track : world.predictions->set.tracks) {
    if (track.kind == TrackKind::Static) statics.push_back(track.bounds(track.motion.start, track.motion.start));
  }
  const GoalFieldKey key{goal.position,          products->version,  digest_of(statics),
                         body_box(request.body), request.flight_box, way_speed(*products, request.limits)};
  auto field = std::make_shared<const GoalField>(make_goal_field(key, products, statics, request.start.p));
  world.goal = std::make_shared<const GoalProducts>(GoalProducts{goal, key, std::move(field), {}});
  return world;
}

PlanningWorld world_of(std::vector<Track> tracks, const Goal& goal, const HorizonRequest& request,
                       const PlannerConfig& config) {
  return world_of(std::move(tracks), goal, request, config, support::free_map({1, 1, 1}));
}

Goal go_to(const Vec3& p) {
  Goal goal;
  goal.header.name = {3, 1};
  goal.id = 1;
  goal.position = p;
  return goal;
}

}  // namespace tern::support
