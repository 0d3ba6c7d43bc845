// Cost of the spline operations that a plan calls thousands of times.
#include "benchmarks/in_turn.h"
#include "core/splines/clamped_spline.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

constexpr int kIntervals = 6;
const std::vector<int> kEach = {0, 1, 2, 3, 4, 5};

ClampedSpline make_spline() {
  Rng rng(1);
  return {support::random_control_points(rng, kIntervals), 0.3};
}

void sample(benchmark::State& state) {
  const ClampedSpline spline = make_spline();
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(spline.sample(t));
    t = t < 1.7 ? t + 0.01 : 0.0;
  }
}
BENCHMARK(sample);

void minvo_of_an_interval(benchmark::State& state) {
  in_turn(state, kEach, [spline = make_spline()](int j) { return spline.minvo(j); });
}
BENCHMARK(minvo_of_an_interval);

void minvo_of_a_part(benchmark::State& state) {
  in_turn(state, kEach, [spline = make_spline()](int j) { return spline.minvo(j, 0.25, 0.5); });
}
BENCHMARK(minvo_of_a_part);

void bounds_of_the_motion(benchmark::State& state) {
  const ClampedSpline spline = make_spline();
  for (auto _ : state) benchmark::DoNotOptimize(motion_bounds(spline));
}
BENCHMARK(bounds_of_the_motion);

void bounds_of_the_position(benchmark::State& state) {
  in_turn(state, kEach, [spline = make_spline()](int j) { return spline.position_bounds(j); });
}
BENCHMARK(bounds_of_the_position);

}  // namespace
}  // namespace tern
