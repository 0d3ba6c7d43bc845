#include "random_scenario.h"

#include <array>
#include <cmath>
#include <limits>

namespace tern {
namespace {

int pick(Rng& rng, int n) { return static_cast<int>(rng.uniform() * n); }

bool toss(Rng& rng) { return rng.uniform() < 0.5; }

Vec3 vec(Rng& rng, double low, double high) {
  const double x = rng.uniform(low, high);
  const double y = rng.uniform(low, high);
  return {x, y, rng.uniform(low, high)};
}

WaypointMotion waypoints(Rng& rng) {
  WaypointMotion motion;
  double t = rng.uniform(-10.0, 10.0);
  for (int n = 2 + pick(rng, 4); n > 0; --n) {
    motion.points.emplace_back(t, vec(rng, -50.0, 50.0));
    t += rng.uniform(0.01, 5.0);
  }
  motion.repeat = toss(rng);
  if (motion.repeat) motion.points.back().second = motion.points.front().second;
  motion.vanish = !motion.repeat && toss(rng);
  if (motion.vanish) motion.leave_out_within_m = rng.uniform(0.0, 5.0);
  return motion;
}

ObstacleSpec obstacle(Rng& rng, int index) {
  ObstacleSpec o;
  if (toss(rng)) o.name = "box no. " + std::to_string(index);
  o.centre = vec(rng, -50.0, 50.0);
  o.half_extents = vec(rng, 0.01, 4.0);
  switch (pick(rng, 5)) {
    case 0: o.motion = StaticMotion{}; break;
    case 1: o.motion = TrefoilMotion{vec(rng, -2.0, 2.0), rng.uniform(0.1, 6.0), rng.uniform(-7.0, 7.0)}; break;
    case 2: o.motion = WaveMotion{vec(rng, -2.0, 2.0), rng.uniform(0.1, 6.0), rng.uniform(-7.0, 7.0)}; break;
    case 3: o.motion = LinearMotion{vec(rng, -9.0, 9.0), rng.uniform(-5.0, 60.0)}; break;
    default: o.motion = waypoints(rng); o.centre = Vec3::Zero();
  }
  return o;
}

RecordedTracksSpec recorded(Rng& rng) {
  RecordedTracksSpec spec;
  spec.file = "crowd/tracks \"a\".txt";
  spec.columns = 6;
  spec.id_column = 1;
  spec.frame_column = 0;
  spec.x_column = 4;
  spec.y_column = 2;
  if (toss(rng)) spec.z_column = 3;
  spec.metres_per_unit = rng.uniform(0.001, 2.0);
  spec.frames_per_second = rng.uniform(1.0, 60.0);
  spec.least_step_s = rng.uniform();
  spec.half_extents = vec(rng, 0.1, 1.0);
  spec.centre_z = rng.uniform(-1.0, 3.0);
  if (rng.uniform() < 0.3) {
    spec.copies = 1 + pick(rng, 9);
    spec.within = Box(vec(rng, -9.0, 0.0), vec(rng, 1.0, 9.0));
    return spec;
  }
  if (toss(rng)) {
    spec.start_s = rng.uniform(0.0, 600.0);
    spec.wait_for_clear_start = toss(rng);
  }
  spec.leave_out_within_m = rng.uniform(0.0, 5.0);
  return spec;
}

Region region(Rng& rng, int index, const std::string& class_name) {
  Region r;
  r.name = "region " + std::to_string(index);
  r.class_name = class_name;
  const Vec3 low = vec(rng, -50.0, 50.0);
  switch (pick(rng, 3)) {
    case 0: r.shape = Box(low, low + vec(rng, 0.1, 9.0)); break;
    case 1: r.shape = BallRegion{low, rng.uniform(0.1, 9.0)}; break;
    default: {
      PrismRegion prism;
      const int n = 3 + pick(rng, 6);
      for (int k = 0; k < n; ++k) {
        const double angle = (k + rng.uniform(0.0, 0.5)) / n * 2.0 * M_PI;
        prism.corners.emplace_back(low.x() + 5.0 * std::cos(angle), low.y() + 5.0 * std::sin(angle));
      }
      prism.z_min = low.z();
      prism.z_max = low.z() + rng.uniform(0.1, 4.0);
      r.shape = prism;
    }
  }
  return r;
}

UavSpec random_uav(Rng& rng) {
  UavSpec uav;
  uav.start = vec(rng, -50.0, 50.0);
  uav.goal = vec(rng, -50.0, 50.0);
  uav.limits.v_max = vec(rng, 0.5, 20.0);
  uav.limits.a_max = vec(rng, 0.5, 50.0);
  if (toss(rng)) uav.limits.j_max = vec(rng, 1.0, 200.0);
  if (toss(rng)) uav.limits.j_max.z() = std::numeric_limits<double>::infinity();
  if (toss(rng)) {
    uav.limits.dynamics =
        Dynamics{rng.uniform(0.0, 9.0), rng.uniform(10.5, 50.0), rng.uniform(1.0, 85.0), rng.uniform(1.0, 2000.0)};
  }
  uav.body.radius = rng.uniform(0.0, 0.5);
  if (toss(rng)) {
    uav.body.radius = 0.0;
    uav.body.vertices.resize(3, 4 + pick(rng, 10));
    for (Eigen::Index k = 0; k < uav.body.vertices.cols(); ++k) uav.body.vertices.col(k) = vec(rng, -0.5, 0.5);
  }
  if (toss(rng)) uav.flight_box = Box(vec(rng, -90.0, -51.0), vec(rng, 51.0, 90.0));
  return uav;
}

struct Comparison {
  std::string first;
  template <class T>
  void operator()(const std::string& field, const T& a, const T& b) {
    if (first.empty() && !(a == b)) first = field;
  }
  void operator()(const std::string& field, const Box& a, const Box& b) {
    (*this)(field, a.min(), b.min());
    (*this)(field, a.max(), b.max());
  }
};

void compare(Comparison& equal, const std::string&, const StaticMotion&, const StaticMotion&) { equal("static", 0, 0); }
void compare(Comparison& equal, const std::string& at, const TrefoilMotion& a, const TrefoilMotion& b) {
  equal(at + "scale", a.scale, b.scale);
  equal(at + "slowness", a.slowness, b.slowness);
  equal(at + "phase", a.phase, b.phase);
}
void compare(Comparison& equal, const std::string& at, const WaveMotion& a, const WaveMotion& b) {
  equal(at + "amplitude", a.amplitude, b.amplitude);
  equal(at + "slowness", a.slowness, b.slowness);
  equal(at + "phase", a.phase, b.phase);
}
void compare(Comparison& equal, const std::string& at, const LinearMotion& a, const LinearMotion& b) {
  equal(at + "velocity", a.velocity, b.velocity);
  equal(at + "from_s", a.from_s, b.from_s);
}
void compare(Comparison& equal, const std::string& at, const WaypointMotion& a, const WaypointMotion& b) {
  equal(at + "points", a.points, b.points);
  equal(at + "repeat", a.repeat, b.repeat);
  equal(at + "vanish", a.vanish, b.vanish);
  equal(at + "leave_out_within_m", a.leave_out_within_m, b.leave_out_within_m);
}
void compare(Comparison& equal, const std::string& at, const Box& a, const Box& b) { equal(at + "box", a, b); }
void compare(Comparison& equal, const std::string& at, const BallRegion& a, const BallRegion& b) {
  equal(at + "centre", a.centre, b.centre);
  equal(at + "radius", a.radius, b.radius);
}
void compare(Comparison& equal, const std::string& at, const PrismRegion& a, const PrismRegion& b) {
  equal(at + "corners", a.corners, b.corners);
  equal(at + "z_min", a.z_min, b.z_min);
  equal(at + "z_max", a.z_max, b.z_max);
}

template <class... Types>
void compare(Comparison& equal, const std::string& at, const std::variant<Types...>& a,
             const std::variant<Types...>& b) {
  equal(at + "kind", a.index(), b.index());
  if (a.index() != b.index()) return;
  std::visit([&](const auto& x) { compare(equal, at, x, std::get<std::decay_t<decltype(x)>>(b)); }, a);
}

void compare(Comparison& equal, const std::string& at, const ObstacleSpec& a, const ObstacleSpec& b) {
  equal(at + "name", a.name, b.name);
  equal(at + "centre", a.centre, b.centre);
  equal(at + "half_extents", a.half_extents, b.half_extents);
  compare(equal, at, a.motion, b.motion);
}

void compare(Comparison& equal, const std::string& at, const RecordedTracksSpec& a, const RecordedTracksSpec& b) {
  equal(at + "file", a.file, b.file);
  equal(at + "columns", a.columns, b.columns);
  equal(at + "id_column", a.id_column, b.id_column);
  equal(at + "frame_column", a.frame_column, b.frame_column);
  equal(at + "x_column", a.x_column, b.x_column);
  equal(at + "y_column", a.y_column, b.y_column);
  equal(at + "z_column", a.z_column, b.z_column);
  equal(at + "metres_per_unit", a.metres_per_unit, b.metres_per_unit);
  equal(at + "frames_per_second", a.frames_per_second, b.frames_per_second);
  equal(at + "least_step_s", a.least_step_s, b.least_step_s);
  equal(at + "start_s", a.start_s, b.start_s);
  equal(at + "leave_out_within_m", a.leave_out_within_m, b.leave_out_within_m);
  equal(at + "copies", a.copies, b.copies);
  if (a.copies > 0) equal(at + "within", a.within, b.within);
  equal(at + "half_extents", a.half_extents, b.half_extents);
  equal(at + "centre_z", a.centre_z, b.centre_z);
  equal(at + "wait_for_clear_start", a.wait_for_clear_start, b.wait_for_clear_start);
}

void compare(Comparison& equal, const std::string& at, const Region& a, const Region& b) {
  equal(at + "name", a.name, b.name);
  equal(at + "class", a.class_name, b.class_name);
  compare(equal, at, a.shape, b.shape);
}

template <class T>
void compare(Comparison& equal, const std::string& at, const std::vector<T>& a, const std::vector<T>& b) {
  equal(at + "size", a.size(), b.size());
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) compare(equal, at + std::to_string(i) + ".", a[i], b[i]);
}

}  // namespace

Scenario random_scenario(Rng& rng) {
  Scenario scenario;
  scenario.name = toss(rng) ? "plain" : "with: \"quotes\" and # signs";
  scenario.seed = static_cast<std::uint64_t>(rng.uniform() * 0x1p62);
  if (toss(rng)) scenario.timeout_s = rng.uniform(1.0, 300.0);
  if (toss(rng)) {
    scenario.world.generator = "sando_forest";
    scenario.world.count = pick(rng, 500);
    if (toss(rng)) scenario.world.slowness = rng.uniform(0.1, 9.0);
  }
  for (int n = pick(rng, 6); n > 0; --n) scenario.world.obstacles.push_back(obstacle(rng, n));
  for (int n = pick(rng, 3); n > 0; --n) scenario.world.recorded.push_back(recorded(rng));
  scenario.uav = random_uav(rng);
  SemanticsSpec& semantics = scenario.semantics;
  semantics.enabled = toss(rng);
  semantics.lambda_attractive = rng.uniform(0.0, 4.0);
  semantics.lambda_repulsive = rng.uniform(0.0, 4.0);
  semantics.cost = toss(rng) ? "exposure" : "mean_distance";
  if (toss(rng))
    semantics.classes = {{"true", "free"}, {"old road", "occupied"}, {"lawn", "unknown"}, {"x", "repulsive"}};
  if (toss(rng)) semantics.lambdas = {{semantics.classes.front().first, rng.uniform(0.0, 4.0)}};
  for (int n = pick(rng, 4); n > 0; --n) {
    const auto& classes = semantics.classes;
    semantics.regions.push_back(region(rng, n, classes[static_cast<std::size_t>(n) % classes.size()].first));
  }
  return scenario;
}

std::string difference(const Scenario& a, const Scenario& b) {
  Comparison equal;
  equal("name", a.name, b.name);
  equal("seed", a.seed, b.seed);
  equal("timeout_s", a.timeout_s, b.timeout_s);
  equal("world.generator", a.world.generator, b.world.generator);
  equal("world.count", a.world.count, b.world.count);
  equal("world.slowness", a.world.slowness, b.world.slowness);
  compare(equal, "world.obstacles.", a.world.obstacles, b.world.obstacles);
  compare(equal, "world.recorded.", a.world.recorded, b.world.recorded);
  equal("uav.start", a.uav.start, b.uav.start);
  equal("uav.goal", a.uav.goal, b.uav.goal);
  equal("uav.limits.v_max", a.uav.limits.v_max, b.uav.limits.v_max);
  equal("uav.limits.a_max", a.uav.limits.a_max, b.uav.limits.a_max);
  equal("uav.limits.j_max", a.uav.limits.j_max, b.uav.limits.j_max);
  const auto none = Dynamics{0.0, 0.0, 0.0, 0.0};
  const auto numbers = [&none](const UavSpec& uav) {
    const Dynamics d = uav.limits.dynamics.value_or(none);
    return std::array{d.thrust_min, d.thrust_max, d.tilt_max_deg, d.body_rate_max_deg_s};
  };
  equal("uav.dynamics", numbers(a.uav), numbers(b.uav));
  equal("uav.body.radius", a.uav.body.radius, b.uav.body.radius);
  equal("uav.body.vertices", a.uav.body.vertices.cols(), b.uav.body.vertices.cols());
  if (equal.first.empty()) equal("uav.body.vertices", a.uav.body.vertices, b.uav.body.vertices);
  equal("uav.flight_box", a.uav.flight_box, b.uav.flight_box);
  equal("semantics.enabled", a.semantics.enabled, b.semantics.enabled);
  equal("semantics.lambda_attractive", a.semantics.lambda_attractive, b.semantics.lambda_attractive);
  equal("semantics.lambda_repulsive", a.semantics.lambda_repulsive, b.semantics.lambda_repulsive);
  equal("semantics.cost", a.semantics.cost, b.semantics.cost);
  equal("semantics.classes", a.semantics.classes, b.semantics.classes);
  equal("semantics.lambdas", a.semantics.lambdas, b.semantics.lambdas);
  compare(equal, "semantics.regions.", a.semantics.regions, b.semantics.regions);
  return equal.first;
}

}  // namespace tern
