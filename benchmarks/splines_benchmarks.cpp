// What the planner asks of a spline thousands of times per plan.
#include <benchmark/benchmark.h>

#include "core/splines/clamped_spline.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

constexpr int kIntervals = 6;

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
  const ClampedSpline spline = make_spline();
  int j = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(spline.minvo(j));
    j = (j + 1) % kIntervals;
  }
}
BENCHMARK(minvo_of_an_interval);

void minvo_of_a_part(benchmark::State& state) {
  const ClampedSpline spline = make_spline();
  int j = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(spline.minvo(j, 0.25, 0.5));
    j = (j + 1) % kIntervals;
  }
}
BENCHMARK(minvo_of_a_part);

void bounds_of_the_motion(benchmark::State& state) {
  const ClampedSpline spline = make_spline();
  for (auto _ : state) benchmark::DoNotOptimize(motion_bounds(spline));
}
BENCHMARK(bounds_of_the_motion);

void bounds_of_the_position(benchmark::State& state) {
  const ClampedSpline spline = make_spline();
  int j = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(spline.position_bounds(j));
    j = (j + 1) % kIntervals;
  }
}
BENCHMARK(bounds_of_the_position);

}  // namespace
}  // namespace tern
