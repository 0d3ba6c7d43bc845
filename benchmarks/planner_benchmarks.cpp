// Cost of the planner and of its stages, on the requests of one flight through paper_corridor 100 (seed 1), recorded at
// the start.
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "benchmarks/in_turn.h"
#include "core/base/percentiles.h"
#include "core/world/flyable.h"
#include "planner/plan_workspace.h"
#include "planner/safety/checker.h"
#include "planner/search/semantic_a_star.h"

namespace tern {
namespace {

/// A request, its world, and the answer.
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

/// plan() over the flight's requests: p50, p99 and maximum in ms of thread CPU time, and the length of the flight.
void plan_of_a_flight(benchmark::State& state) {
  std::vector<double> ms;
  PlanWorkspace workspace;
  for (auto _ : state) {
    for (const Answered& m : flight()) {
      ms.push_back(plan_ms(m, recording().config, workspace));
    }
  }
  const Percentiles took = percentiles(ms);
  state.counters["p50_ms"] = took.p50;
  state.counters["p99_ms"] = took.p99;
  state.counters["max_ms"] = took.max;
  state.counters["flight_s"] = recording().result.flight_time_s;
}
BENCHMARK(plan_of_a_flight)->Unit(benchmark::kMillisecond)->Iterations(1);

SeparationCache& sweep(const Answered& m, SweptHorizon& swept) {
  std::vector<double> times;
  for (int k = 0; k <= 12; ++k) times.push_back(k * m.answer.trajectory.interval.seconds());
  return swept.assign(m.world.predictions->obstacles, m.request.body, m.request.t_s, times,
                      box_around(m.request.start.p, Vec3::Constant(4.0)));
}

/// Requests of the flight whose answer is a new trajectory.
std::vector<const Answered*> planned() {
  std::vector<const Answered*> out;
  for (const Answered& m : flight()) {
    if (m.answer.outcome == PlanOutcome::Optimized || m.answer.outcome == PlanOutcome::SearchOnly) out.push_back(&m);
  }
  return out;
}

/// The same with their obstacles.
struct Swept {
  const Answered* moment = nullptr;
  std::unique_ptr<SweptHorizon> horizon = std::make_unique<SweptHorizon>();
};
std::vector<Swept> swept_moments() {
  std::vector<Swept> all;
  for (const Answered* m : planned()) {
    all.emplace_back().moment = m;
    sweep(*m, *all.back().horizon);
  }
  return all;
}

/// Reports a rate as the time per item.
benchmark::Counter time_of_each(std::int64_t count) {
  return {static_cast<double>(count), benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

/// Selecting the tracks that can matter.
void index_query(benchmark::State& state) {
  std::vector<std::int32_t> found;
  in_turn(state, planned(), [&](const Answered* m) {
    m->world.predictions->index.query(box_around(m->request.start.p, Vec3::Constant(4.2)), found);
    return found.data();
  });
}
BENCHMARK(index_query);

/// Cutting the obstacles of a horizon into boxes.
void swept_boxes(benchmark::State& state) {
  SweptHorizon swept;
  in_turn(state, planned(), [&](const Answered* m) { return sweep(*m, swept).obstacles().intervals(); });
}
BENCHMARK(swept_boxes)->Unit(benchmark::kMicrosecond);

/// Calls work(cache, interval, neighbour) for every neighbour of six intervals of each request, with an empty cache.
template <class Work>
void for_each_neighbour(benchmark::State& state, const Work& work) {
  const auto moments = planned();
  std::size_t k = 0;
  std::int64_t candidates = 0;
  SweptHorizon swept;
  for (auto _ : state) {
    state.PauseTiming();
    const Answered& m = *moments[k++ % moments.size()];
    sweep(m, swept);
    state.ResumeTiming();
    for (int j = 0; j < 6; ++j) {
      for (const auto& neighbour : swept.obstacles.neighbours(j)) {
        if (!swept.obstacles.obstacle(neighbour).moves()) continue;
        work(swept.cache, j, neighbour);
        ++candidates;
      }
    }
  }
  state.counters["each"] = time_of_each(candidates);
}

/// One sweep of a moving obstacle over an interval, as boxes.
void swept_samples(benchmark::State& state) {
  for_each_neighbour(state, [](SeparationCache& cache, int j, const SweptObstacles::Neighbour& neighbour) {
    benchmark::DoNotOptimize(cache.sweep(neighbour, {j}).boxes.data());
  });
}
BENCHMARK(swept_samples)->Unit(benchmark::kMicrosecond);

/// One hull of a moving obstacle, by CGAL.
void swept_hull(benchmark::State& state) {
  for_each_neighbour(state, [](SeparationCache& cache, int j, const SweptObstacles::Neighbour& neighbour) {
    benchmark::DoNotOptimize(cache.hull(neighbour, {j}).data());
  });
}
BENCHMARK(swept_hull)->Unit(benchmark::kMicrosecond);

/// Testing whether an interval of the answer is clear, per pair of obstacle and interval, boxes and caches included.
void separation_in_flight(benchmark::State& state) {
  PairCounts pairs;
  in_turn(state, swept_moments(), [&](const Swept& swept) {
    const ClampedSpline spline = swept.moment->answer.trajectory.spline();
    bool all = true;
    for (int j = 0; j < spline.intervals(); ++j) {
      all = is_separated(swept.horizon->cache, j, spline.power(j), spline.minvo(j), pairs) && all;
    }
    return all;
  });
  state.counters["per_pair"] = time_of_each(pairs.by_box + pairs.by_cache + pairs.by_plane + pairs.by_instant);
}
BENCHMARK(separation_in_flight)->Unit(benchmark::kMicrosecond);

/// The planes that the optimizer starts from: those of all sweeps within a metre.
void gather_planes(benchmark::State& state) {
  std::vector<CertificatePlane> planes;
  PairCounts pairs;
  in_turn(state, swept_moments(), [&](const Swept& swept) {
    planes.clear();
    find_planes(swept.horizon->cache, swept.moment->answer.trajectory.spline(), HullBasis::Minvo, 1.0, pairs, planes);
    return planes.data();
  });
}
BENCHMARK(gather_planes)->Unit(benchmark::kMicrosecond);

/// The convex problem of the answer.
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

/// Checking with finished hulls, and the cost per pair (boxes included).
void check_a_plan(benchmark::State& state) {
  std::int64_t pairs = 0;
  in_turn(state, swept_moments(), [&](const Swept& swept) {
    const Answered& m = *swept.moment;
    const CheckReport report = check_plan(m.answer.trajectory, problem_of(m), swept.obstacles);
    return pairs += report.pairs.by_box + report.pairs.by_plane;
  });
  state.counters["per_pair"] = time_of_each(pairs);
}
BENCHMARK(check_a_plan)->Unit(benchmark::kMicrosecond);

/// One search at the answer's own Δt, sweeps included.
void search(benchmark::State& state) {
  std::int64_t expansions = 0;
  SweptObstacles swept;
  SearchMemory memory;
  in_turn(state, planned(), [&](const Answered* m) {
    sweep(*m, swept);
    SearchProblem problem{problem_of(*m)};
    problem.cost_to_go.point = m->answer.local_goal;
    Budget budget = Budget::unlimited();
    return expansions += semantic_a_star(problem, recording().config.search, swept, budget, memory).expansions;
  });
  state.counters["expansions/s"] = benchmark::Counter(static_cast<double>(expansions), benchmark::Counter::kIsRate);
}
BENCHMARK(search)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tern
