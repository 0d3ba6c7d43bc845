// Cost of separate() as in flight: a hull of some 20 vertices against the 4 MINVO points of an interval. Cost of
// hull_vertices() of swept boxes.
#include "benchmarks/in_turn.h"
#include "core/base/random.h"
#include "core/geometry/box.h"
#include "core/geometry/convex_hull.h"
#include "core/geometry/distance.h"
#include "core/geometry/separation.h"
#include "core/geometry/separation_lp.h"

namespace tern {
namespace {

constexpr int kCases = 256;

Vec3 random_vector(Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)};
}

// All corners of a sampled box of 0.8 m that flies a parabola for 0.5 s.
Points swept_box(Rng& rng, int samples) {
  const Vec3 velocity = random_vector(rng, 3.0);
  const Vec3 acceleration = random_vector(rng, 4.0);
  Points points(3, 8 * samples);
  for (int k = 0; k < samples; ++k) {
    const double t = 0.5 * k / (samples - 1);
    const Vec3 centre = velocity * t + 0.5 * acceleration * t * t;
    points.middleCols<8>(8 * k) = box_corners(box_around(centre, Vec3::Constant(0.4)));
  }
  return points;
}

struct Pair {
  Points hull, interval;
};

// Hulls of swept boxes, and for each four points within half a metre of each other, at distance `gap`.
std::vector<Pair> pairs_at(double gap) {
  Rng rng(7);
  std::vector<Pair> pairs;
  while (pairs.size() < kCases) {
    Pair pair{hull_vertices(swept_box(rng, 6)), Points(3, 4)};
    for (int k = 0; k < 4; ++k) pair.interval.col(k) = random_vector(rng, 0.25);
    const Vec3 away = random_vector(rng, 1.0).normalized();
    pair.interval.colwise() += 8.0 * away;
    const ShortestVector shortest = shortest_vector(pair.hull, pair.interval, 0.0);
    pair.interval.colwise() += shortest.v * (1.0 - gap / shortest.upper);
    pairs.push_back(pair);
  }
  return pairs;
}

void separate_in_flight(benchmark::State& state) {
  const std::vector<Pair> pairs = pairs_at(static_cast<double>(state.range(0)) * 1e-3);
  double vertices = 0.0;
  for (const Pair& pair : pairs) vertices += static_cast<double>(pair.hull.cols()) / kCases;
  const long lp_before = separation_counts().lp;
  in_turn(state, pairs, [](const Pair& pair) { return separate(pair.hull, pair.interval, 0.2); });
  state.counters["vertices"] = vertices;
  state.counters["lp"] = static_cast<double>(separation_counts().lp - lp_before);
}
BENCHMARK(separate_in_flight)->ArgName("gap_mm")->Arg(0)->Arg(100)->Arg(300)->Arg(1000)->Arg(3000);

void separate_by_glpk(benchmark::State& state) {
  in_turn(state, pairs_at(1.0), [](const Pair& pair) { return separate_by_lp(pair.hull, pair.interval); });
}
BENCHMARK(separate_by_glpk);

void hull_of_a_swept_box(benchmark::State& state) {
  Rng rng(7);
  std::vector<Points> sweeps;
  for (int k = 0; k < kCases; ++k) sweeps.push_back(swept_box(rng, static_cast<int>(state.range(0))));
  in_turn(state, sweeps, hull_vertices);
}
BENCHMARK(hull_of_a_swept_box)->ArgName("samples")->Arg(2)->Arg(5)->Arg(8)->Arg(10);

}  // namespace
}  // namespace tern
