// Cost of a set of detections of n swinging objects, seen at 30 Hz without ids.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/base/random.h"
#include "core/wire/message_limits.h"
#include "predictor/tracking/tracker.h"

namespace tern {
namespace {

constexpr double kRate = 30.0, kNoise = 0.05, kDropout = 0.05;
constexpr int kWarm = 90, kSets = 300, kFloodSets = 60;

/// Each object has an area of 4 m × 4 m.
std::vector<ObservationSet> sets_of(std::int64_t things) {
  Rng rng(1);
  std::vector<Vec3> phases;
  for (std::int64_t k = 0; k < things; ++k) {
    phases.emplace_back(rng.uniform(0.0, 6.3), rng.uniform(0.0, 6.3), rng.uniform(0.0, 6.3));
  }
  std::vector<ObservationSet> sets;
  for (int n = 0; n < kSets; ++n) {
    const double t = n / kRate;
    ObservationSet set;
    set.at = UTime{1'000'000} + Duration::from_seconds(t);
    for (std::int64_t k = 0; k < things; ++k) {
      if (rng.uniform() < kDropout) continue;
      const Vec3& phase = phases[static_cast<std::size_t>(k)];
      const Vec3 centre(4.0 * static_cast<double>(k % 10), 4.0 * static_cast<double>(k / 10), 1.0);
      Detection detection;
      detection.position = centre + (phase.array() + 1.2 * t).sin().matrix();
      for (int axis = 0; axis < 3; ++axis) detection.position[axis] += kNoise * rng.normal();
      detection.half_extents = Vec3::Constant(0.3);
      detection.variance = Vec3::Constant(kNoise * kNoise);
      detection.track_id = kNoTrackId;
      set.detections.push_back(detection);
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

/// A flood: the most detections of a set, at random places in each.
std::vector<ObservationSet> flood() {
  Rng rng(1);
  std::vector<ObservationSet> sets;
  for (int n = 0; n < kFloodSets; ++n) {
    ObservationSet set;
    set.at = UTime{1'000'000} + Duration::from_seconds(n / kRate);
    for (int k = 0; k < kMaxDetections; ++k) {
      Detection detection;
      detection.position = Vec3(rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0), rng.uniform(0.0, 4.0));
      detection.half_extents = Vec3::Constant(0.3);
      detection.variance = Vec3::Constant(kNoise * kNoise);
      detection.track_id = kNoTrackId;
      set.detections.push_back(detection);
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

// learns: with the model that is learnt in flight.
Tracker warm(const std::vector<ObservationSet>& sets, bool learns) {
  TrackerConfig config;
  config.learns = learns;
  Tracker tracker(config);
  for (int n = 0; n < kWarm; ++n) tracker.update(sets[static_cast<std::size_t>(n)]);
  return tracker;
}

/// Assigns and filters a set, and scores earlier predictions.
void tracker_update(benchmark::State& state) {
  const std::vector<ObservationSet> sets = sets_of(state.range(0));
  const Tracker begun = warm(sets, state.range(1) != 0);
  Tracker tracker = begun;
  std::size_t next = kWarm;
  for (auto _ : state) {
    if (next == sets.size()) {
      state.PauseTiming();
      tracker = begun;
      next = kWarm;
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(tracker.update(sets[next++]));
  }
}
BENCHMARK(tracker_update)
    ->ArgNames({"things", "learns"})
    ->ArgsProduct({{20, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

/// Predicts all tracks over 4.5 s, with α at five confidences.
void tracker_predict(benchmark::State& state) {
  const Tracker tracker = warm(sets_of(state.range(0)), state.range(1) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(tracker.predict(tracker.newest()).data());
}
BENCHMARK(tracker_predict)
    ->ArgNames({"things", "learns"})
    ->ArgsProduct({{20, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

/// A set of a flood: matched and filtered, with earlier predictions scored.
void flood_update(benchmark::State& state) {
  const std::vector<ObservationSet> sets = flood();
  Tracker tracker(TrackerConfig{});
  std::size_t next = 0;
  for (auto _ : state) {
    if (next == sets.size()) {
      state.PauseTiming();
      tracker = Tracker(TrackerConfig{});
      next = 0;
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(tracker.update(sets[next++]));
  }
}
BENCHMARK(flood_update)->Unit(benchmark::kMillisecond);

/// Predicts the tracks of a flood.
void flood_predict(benchmark::State& state) {
  Tracker tracker(TrackerConfig{});
  for (const ObservationSet& set : flood()) tracker.update(set);
  for (auto _ : state) benchmark::DoNotOptimize(tracker.predict(tracker.newest()).data());
}
BENCHMARK(flood_predict)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tern
