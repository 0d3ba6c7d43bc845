// Cost of one frame of the estimator in flight: 150 tracks and 11 clones, or fewer.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "tests/support/vio_flight.h"

namespace tern {
namespace {

/// A flight of 16 s at 20 Hz. Reports the median and the 99th percentile of its frames, ms.
void estimator_frames(benchmark::State& state) {
  support::VioSettings settings;
  settings.camera.most_tracks = static_cast<int>(state.range(0));
  EstimatorConfig config;
  config.clones = static_cast<int>(state.range(1));
  const support::VioPath path = support::weaving();
  const auto events = simulate(path, support::landmarks_of({}, 1), settings, 1);
  std::vector<double> frames;
  for (auto _ : state) {
    Estimator estimator(config, {PointInW{path.start}, path.yaw(0.0)});
    for (const support::VioEvent& event : events) {
      if (!event.is_frame) {
        estimator.add(event.sample);
        continue;
      }
      const auto begun = std::chrono::steady_clock::now();
      estimator.add(event.frame);
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
      if (event.t > 0.0) frames.push_back(took.count());
    }
    benchmark::DoNotOptimize(estimator.estimate());
  }
  std::sort(frames.begin(), frames.end());
  state.counters["p50_ms"] = frames[frames.size() / 2];
  state.counters["p99_ms"] = frames[frames.size() * 99 / 100];
}
BENCHMARK(estimator_frames)->Args({150, 11})->Args({80, 8})->Args({30, 11})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tern
