// The planner's stages and the whole of it, on the requests of one flight through paper_corridor 100 (seed 1), recorded
// here.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "core/base/percentiles.h"
#include "core/splines/minvo.h"
#include "core/world/flyable.h"
#include "planner/plan_workspace.h"
#include "planner/safety/checker.h"
#include "planner/search/semantic_a_star.h"

namespace tern {
namespace {

/// A request, its world, and what is answered.
struct Answered : Moment {
  Plan answer;
};

const FlightRecording& recording() {
  static const FlightRecording flown =
      record_flight(std::string(TERN_SCENARIOS) + "/paper_corridor.yaml", {"seed=1", "world.count=100"});
  return flown;
}

const std::vector<Answered>& flight() {
  static const std::vector<Answered> moments = [] {
    std::vector<Answered> answered;
    for (const Moment& m : recording().moments) {
      Budget budget = Budget::unlimited();
      answered.push_back({m, plan(m.request, m.world, recording().config, budget).plan});
    }
    return answered;
  }();
  return moments;
}

/// plan() over the flight's requests; p50, p99, max in ms of the thread's CPU time, and how long the flight was.
void plan_of_a_flight(benchmark::State& state) {
  std::vector<double> ms;
  PlanWorkspace workspace;
  for (auto _ : state) {
    for (const Answered& m : flight()) {
      ms.push_back(plan_ms(m, recording().config, workspace));
    }
  }
  std::sort(ms.begin(), ms.end());
  state.counters["p50_ms"] = percentile_of_sorted(ms, 50);
  state.counters["p99_ms"] = percentile_of_sorted(ms, 99);
  state.counters["max_ms"] = ms.back();
  state.counters["flight_s"] = recording().result.flight_time_s;
}
BENCHMARK(plan_of_a_flight)->Unit(benchmark::kMillisecond)->Iterations(1);

void sweep(const std::vector<PlanningObstacle>& obstacles, const Answered& m, SweptObstacles& swept) {
  std::vector<double> times;
  for (int k = 0; k <= 12; ++k) times.push_back(k * m.answer.trajectory.interval.seconds());
  swept.assign(obstacles, m.request.body, m.request.t_s, times, box_around(m.request.start.p, Vec3::Constant(4.0)));
}

std::vector<SweptObstacles> sweeps_of(const std::vector<const Answered*>& moments) {
  std::vector<SweptObstacles> swept(moments.size());
  for (std::size_t k = 0; k < moments.size(); ++k)
    sweep(moments[k]->world.predictions->obstacles, *moments[k], swept[k]);
  return swept;
}

/// Moments of the flight whose answer is a new trajectory.
std::vector<const Answered*> planned() {
  std::vector<const Answered*> out;
  for (const Answered& m : flight()) {
    if (m.answer.outcome == PlanOutcome::Optimized || m.answer.outcome == PlanOutcome::SearchOnly) out.push_back(&m);
  }
  return out;
}

/// Which tracks can matter.
void index_query(benchmark::State& state) {
  const auto moments = planned();
  std::vector<std::int32_t> found;
  std::size_t k = 0;
  for (auto _ : state) {
    const Answered& m = *moments[k++ % moments.size()];
    m.world.predictions->index.query(box_around(m.request.start.p, Vec3::Constant(4.2)), found);
    benchmark::DoNotOptimize(found.data());
  }
}
BENCHMARK(index_query);

/// Cutting the obstacles of a horizon into boxes.
void swept_boxes(benchmark::State& state) {
  const auto moments = planned();
  SweptObstacles swept;
  std::size_t k = 0;
  for (auto _ : state) {
    const Answered& m = *moments[k++ % moments.size()];
    sweep(m.world.predictions->obstacles, m, swept);
    benchmark::DoNotOptimize(swept.intervals());
  }
}
BENCHMARK(swept_boxes)->Unit(benchmark::kMicrosecond);

/// Calls work(swept, interval, candidate) for every candidate of six intervals of each moment, sweeps not made yet.
template <class Work>
void for_each_candidate(benchmark::State& state, const Work& work) {
  const auto moments = planned();
  std::size_t k = 0;
  std::int64_t candidates = 0;
  SweptObstacles swept;
  for (auto _ : state) {
    state.PauseTiming();
    const Answered& m = *moments[k++ % moments.size()];
    sweep(m.world.predictions->obstacles, m, swept);
    state.ResumeTiming();
    for (int j = 0; j < 6; ++j) {
      for (const auto& candidate : swept.candidates(j)) {
        if (!swept.obstacle(candidate).moves()) continue;
        work(swept, j, candidate);
        ++candidates;
      }
    }
  }
  state.counters["each"] =
      benchmark::Counter(static_cast<double>(candidates), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// One sweep of a moving obstacle over an interval, as boxes.
void swept_samples(benchmark::State& state) {
  for_each_candidate(state, [](SweptObstacles& swept, int j, const SweptObstacles::Candidate& candidate) {
    benchmark::DoNotOptimize(swept.sweep(candidate, {j}).boxes.data());
  });
}
BENCHMARK(swept_samples)->Unit(benchmark::kMicrosecond);

/// One hull of a moving obstacle, by CGAL.
void swept_hull(benchmark::State& state) {
  for_each_candidate(state, [](SweptObstacles& swept, int j, const SweptObstacles::Candidate& candidate) {
    benchmark::DoNotOptimize(swept.hull(candidate, {j}).data());
  });
}
BENCHMARK(swept_hull)->Unit(benchmark::kMicrosecond);

/// Is an interval of the answer clear? Yes or no, per pair of obstacle and interval, boxes and caches included.
void separation_in_flight(benchmark::State& state) {
  const auto moments = planned();
  std::vector<SweptObstacles> swept = sweeps_of(moments);
  std::size_t k = 0;
  PairCounts pairs;
  for (auto _ : state) {
    const std::size_t i = k++ % moments.size();
    const ClampedSpline spline = moments[i]->answer.trajectory.spline();
    for (int j = 0; j < spline.intervals(); ++j) {
      benchmark::DoNotOptimize(is_clear(swept[i], j, spline.power(j), spline.minvo(j), pairs));
    }
  }
  state.counters["per_pair"] =
      benchmark::Counter(static_cast<double>(pairs.by_box + pairs.by_cache + pairs.by_plane + pairs.by_instant),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(separation_in_flight)->Unit(benchmark::kMicrosecond);

/// The planes that the optimizer starts from: all within a metre, made from sweeps.
void gather_planes(benchmark::State& state) {
  const auto moments = planned();
  std::vector<SweptObstacles> swept = sweeps_of(moments);
  std::vector<CertificatePlane> planes;
  std::size_t k = 0;
  PairCounts pairs;
  for (auto _ : state) {
    const std::size_t i = k++ % moments.size();
    const ClampedSpline spline = moments[i]->answer.trajectory.spline();
    planes.clear();
    find_planes(swept[i], spline, HullBasis::Minvo, 1.0, pairs, planes);
    benchmark::DoNotOptimize(planes.data());
  }
}
BENCHMARK(gather_planes)->Unit(benchmark::kMicrosecond);

/// What the answer solves.
HorizonProblem problem_of(const Answered& m) {
  Limits reduced = m.request.limits;
  reduced.v_max *= recording().config.velocity_share;
  return {m.request.start,
          6,
          m.answer.trajectory.interval,
          m.request.limits,
          reduced,
          4.0,
          centre_box(m.request.flight_box, m.request.body),
          m.request.body.radius,
          HullBasis::Minvo};
}

/// The checker with its hulls made, and what it costs per pair (boxes included).
void check_a_plan(benchmark::State& state) {
  const auto moments = planned();
  std::vector<SweptObstacles> swept = sweeps_of(moments);
  std::size_t k = 0;
  std::int64_t pairs = 0;
  for (auto _ : state) {
    const std::size_t i = k++ % moments.size();
    const Answered& m = *moments[i];
    const CheckReport report = check_plan(m.answer.trajectory, problem_of(m), swept[i]);
    pairs += report.pairs.by_box + report.pairs.by_plane;
  }
  state.counters["per_pair"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(check_a_plan)->Unit(benchmark::kMicrosecond);

/// One search at the answer's own Δt, sweeps included.
void search(benchmark::State& state) {
  const auto moments = planned();
  std::size_t k = 0;
  std::int64_t expansions = 0;
  SweptObstacles swept;
  SearchMemory memory;
  for (auto _ : state) {
    const Answered& m = *moments[k++ % moments.size()];
    sweep(m.world.predictions->obstacles, m, swept);
    SearchProblem problem{problem_of(m)};
    problem.way.point = m.answer.local_goal;
    Budget budget = Budget::unlimited();
    expansions += semantic_a_star(problem, recording().config.search, swept, budget, memory).expansions;
  }
  state.counters["expansions/s"] = benchmark::Counter(static_cast<double>(expansions), benchmark::Counter::kIsRate);
}
BENCHMARK(search)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tern
