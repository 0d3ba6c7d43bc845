#include "tests/support/legal_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/geometry/box.h"
#include "runtime/scenario_file.h"
#include "simulator/worlds/obstacle.h"

namespace tern::testing {
namespace {

bool toss(Rng& rng, double probability = 0.5) { return rng.uniform() < probability; }
int pick(Rng& rng, int n) { return static_cast<int>(rng.uniform() * n); }
double log_uniform(Rng& rng, double low, double high) { return low * std::pow(high / low, rng.uniform()); }

Vec3 vec(Rng& rng, double low, double high) {
  const double x = rng.uniform(low, high);
  const double y = rng.uniform(low, high);
  return {x, y, rng.uniform(low, high)};
}

/// One number for all axes, or three.
Vec3 limit(Rng& rng, double low, double high) {
  if (toss(rng, 0.7)) return Vec3::Constant(log_uniform(rng, low, high));
  const double x = log_uniform(rng, low, high);
  const double y = log_uniform(rng, low, high);
  return {x, y, log_uniform(rng, low, high)};
}

Limits random_limits(Rng& rng) {
  Limits limits;
  limits.v_max = limit(rng, toss(rng, 0.1) ? kMinLimit : 0.05, kMaxSpeedLimit);
  limits.a_max = limit(rng, toss(rng, 0.3) ? kMinLimit : 0.05, kMaxAccelerationLimit);
  if (toss(rng)) limits.j_max = limit(rng, toss(rng, 0.3) ? kMinLimit : 0.05, 1e6);
  return limits;
}

Body random_body(Rng& rng) {
  Body body;
  switch (pick(rng, 4)) {
    case 0: body.radius = rng.uniform(0.05, 0.5); return body;
    case 1: body.radius = 0.0; return body;
    case 2: {
      body.radius = 0.0;
      const Vec3 h = vec(rng, 0.05, 0.4);
      body.vertices = box_corners(Box(-h, h));
      return body;
    }
    default: {
      body.radius = 0.0;
      body.vertices.resize(3, 4 + pick(rng, 8));
      for (Eigen::Index k = 0; k < body.vertices.cols(); ++k) body.vertices.col(k) = vec(rng, -0.4, 0.4);
      return body;
    }
  }
}

/// The planner's and the executor's knobs that change how far and how long is planned.
struct Knobs {
  double sphere_radius_m = 4.0;
  int intervals = 6;
  double hold_required_s = 0.5, hold_cap_s = 1.5;
  double rate_hz = 20.0;
};

Knobs random_knobs(Rng& rng) {
  Knobs knobs;
  knobs.sphere_radius_m = toss(rng, 0.3) ? log_uniform(rng, 0.1, 1000.0) : rng.uniform(2.0, 6.0);
  if (toss(rng, 0.3)) knobs.intervals = 4 + pick(rng, 9);
  if (toss(rng, 0.3)) knobs.hold_cap_s = log_uniform(rng, 0.1, 10.0);
  if (toss(rng, 0.3)) knobs.hold_required_s = rng.uniform(0.0, 10.0);
  knobs.hold_cap_s = std::max(knobs.hold_cap_s, knobs.hold_required_s);
  return knobs;
}

/// The obstacles around the flight.
enum class Around { Nothing, Statics, FarMovers, Movers };

/// Returns a speed that the vehicle surely reaches by hops from rest to rest. Each hop is within the sphere and within
/// the predicted time, at the rate of requests.
double hopping_speed(const Limits& limits, const Knobs& knobs, const Vec3& direction, Around around) {
  const double foreseen_s = around == Around::Movers ? 1.2 : 60.0;
  double hop = 0.8 * knobs.sphere_radius_m;
  const auto time = [&](double h) { return 1.4 * rest_to_rest_bound_s(Vec3::Zero(), h * direction, limits); };
  for (int k = 0; k < 300 && time(hop) > foreseen_s; ++k) hop *= 0.9;
  return hop / std::max(time(hop), 1.0 / knobs.rate_hz + 0.1);
}

ObstacleSpec random_static(Rng& rng, const Box& where) {
  ObstacleSpec o;
  o.half_extents = vec(rng, 0.05, 1.0);
  if (toss(rng, 0.2)) o.half_extents[pick(rng, 3)] = rng.uniform(1.0, 5.0);
  for (int i = 0; i < 3; ++i) o.centre[i] = rng.uniform(where.min()[i], where.max()[i]);
  o.motion = StaticMotion{};
  return o;
}

ObstacleSpec random_mover(Rng& rng, const Box& where) {
  ObstacleSpec o = random_static(rng, where);
  o.half_extents = vec(rng, 0.05, 0.6);
  const double speed = log_uniform(rng, 0.1, 8.0);
  switch (pick(rng, 4)) {
    case 0: o.motion = TrefoilMotion{vec(rng, 0.2, 1.5), 7.5 / speed, rng.uniform(-3.0, 3.0)}; break;
    case 1: o.motion = WaveMotion{vec(rng, -2.0, 2.0), 2.0 / speed, rng.uniform(-3.0, 3.0)}; break;
    case 2: {
      const Vec3 v = vec(rng, -speed, speed);
      o.centre -= v * rng.uniform(0.0, 20.0);
      o.motion = LinearMotion{v, toss(rng) ? 0.0 : rng.uniform(0.0, 10.0)};
      break;
    }
    default: {
      WaypointMotion m;
      double t = rng.uniform(-5.0, 5.0);
      for (int n = 2 + pick(rng, 4); n > 0; --n) {
        m.points.emplace_back(t, random_static(rng, where).centre);
        t += rng.uniform(2.0, 20.0);
      }
      m.repeat = toss(rng, 0.3);
      if (m.repeat) m.points.back().second = m.points.front().second;
      m.vanish = !m.repeat && m.points.back().first > 1.0 && toss(rng, 0.3);
      o.motion = m;
      o.centre.setZero();
    }
  }
  return o;
}

/// A mover that does not come near while the flight lasts.
ObstacleSpec far_mover(Rng& rng, const Box& where) {
  ObstacleSpec o;
  o.half_extents = vec(rng, 0.1, 1.0);
  o.centre = where.max() + Vec3::Constant(rng.uniform(1500.0, 3000.0));
  o.motion = LinearMotion{vec(rng, 0.1, 1.0), 0.0};
  return o;
}

Vec3 where_at(const ObstacleSpec& o, double t_s) { return WorldObstacle::make(0, o)->at(t_s).p; }

bool comes_near(const ObstacleSpec& o, const Vec3& p, double room) {
  for (double t = 0.0; t <= 2.0; t += 0.1) {
    if (distance_to_box(p, where_at(o, t), o.half_extents) < room) return true;
  }
  return false;
}

std::vector<ObstacleSpec> random_obstacles(Rng& rng, const UavSpec& uav, Around around) {
  std::vector<ObstacleSpec> obstacles;
  if (around == Around::Nothing) return obstacles;
  const double distance = (uav.goal - uav.start).norm();
  const Box where = grown(Box(uav.start.cwiseMin(uav.goal), uav.start.cwiseMax(uav.goal)),
                          Vec3::Constant(std::max(2.0, 0.2 * distance)));
  const double room = uav.body.half_extents().norm() + 0.1;
  const bool on_start = toss(rng, 0.03);
  for (int n = 1 + pick(rng, 6); n > 0; --n) {
    const bool moves = around == Around::Movers && toss(rng, 0.6);
    ObstacleSpec o = moves ? random_mover(rng, where) : random_static(rng, where);
    if (!on_start && comes_near(o, uav.start, room)) continue;
    if (!moves && !toss(rng, 0.03) && comes_near(o, uav.goal, room)) continue;
    obstacles.push_back(o);
  }
  if (around == Around::FarMovers) obstacles.push_back(far_mover(rng, where));
  return obstacles;
}

void add_regions(Rng& rng, Scenario& scenario) {
  SemanticsSpec& semantics = scenario.semantics;
  semantics.enabled = toss(rng, 0.9);
  semantics.cost = toss(rng) ? "exposure" : "mean_distance";
  semantics.lambda_attractive = rng.uniform(0.0, 4.0);
  semantics.lambda_repulsive = rng.uniform(0.0, 4.0);
  for (int n = pick(rng, 3); n > 0; --n) {
    Region region;
    region.name = fmt::format("region {}", n);
    region.class_name = toss(rng) ? "texture" : "water";
    const Vec3 centre = scenario.uav.start + rng.uniform() * (scenario.uav.goal - scenario.uav.start);
    if (toss(rng)) {
      region.shape = BallRegion{centre + vec(rng, -2.0, 2.0), rng.uniform(0.3, 3.0)};
    } else {
      region.shape = box_around(centre + vec(rng, -2.0, 2.0), vec(rng, 0.3, 3.0));
    }
    semantics.regions.push_back(region);
  }
}

}  // namespace

LegalScenario legal_scenario(std::uint64_t seed) {
  Rng rng(seed);
  LegalScenario legal;
  Scenario& scenario = legal.scenario;
  scenario.name = fmt::format("legal_{}", seed);
  scenario.seed = seed;
  UavSpec& uav = scenario.uav;
  uav.limits = random_limits(rng);
  uav.body = random_body(rng);
  Knobs knobs = random_knobs(rng);
  const Around around = static_cast<Around>(pick(rng, 4));
  uav.start = vec(rng, -50.0, 50.0);
  const Vec3 direction = vec(rng, -1.0, 1.0).normalized();
  const double flight_s = log_uniform(rng, 1.0, 40.0);
  double distance = 0.0;
  for (const double rate : {20.0, 5.0, 2.0}) {  // a slow flight need not ask so often
    knobs.rate_hz = rate;
    distance = std::min(300.0, 0.3 + hopping_speed(uav.limits, knobs, direction, around) * flight_s);
    if (flight_s * rate < 100.0) break;
  }
  uav.goal = uav.start + distance * direction;
  const double needed_s = distance / hopping_speed(uav.limits, knobs, direction, around);
  // A jerk limit costs hops more than the bound says; regions cost detours, perhaps along a slow axis.
  const bool regions = toss(rng, 0.3);
  scenario.timeout_s = (uav.limits.j_max.allFinite() || regions ? 8.0 : 3.0) * needed_s + 10.0;
  if (toss(rng, 0.4)) {
    uav.flight_box = grown(Box(uav.start.cwiseMin(uav.goal), uav.start.cwiseMax(uav.goal)),
                           uav.body.half_extents() + Vec3::Constant(log_uniform(rng, 0.1, 5.0)));
  }
  scenario.world.obstacles = random_obstacles(rng, uav, around);
  if (regions) add_regions(rng, scenario);
  legal.yaml = write_scenario(scenario) +
               fmt::format(
                   "planner: {{sphere_radius_m: {}, intervals: {}, hold_required_s: {}, hold_cap_s: {}}}\n"
                   "executor: {{rate_hz: {}}}\n",
                   knobs.sphere_radius_m, knobs.intervals, knobs.hold_required_s, knobs.hold_cap_s, knobs.rate_hz);
  return legal;
}

}  // namespace tern::testing
