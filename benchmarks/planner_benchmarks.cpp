// The planner's stages and the whole of it, on the requests of one flight through paper_corridor 100 (seed 1), recorded
// here.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "planner/optimization/convex_problem.h"
#include "planner/optimization/ipopt_solver.h"
#include "planner/planner.h"
#include "planner/safety/checker.h"
#include "planner/search/semantic_a_star.h"
#include "runtime/stopwatch.h"
#include "simulator/worlds/declared_motions.h"
#include "simulator/worlds/world.h"
#include "tests/support/plan_judge.h"

namespace tern {
namespace {

constexpr UTime kWorldZero{100'000'000};

struct Moment {
  HorizonRequest request;
  PlanningWorld world;
  Plan answer;
};

Scenario corridor() {
  Scenario scenario;
  scenario.seed = 1;
  scenario.world.generator = "paper_corridor";
  scenario.world.count = 100;
  scenario.uav.flight_box = Box(Vec3(-10, -3, 0), Vec3(90, 3, 4));
  return scenario;
}

/// Every request of a flight at 20 Hz, with the world that it was planned in.
const std::vector<Moment>& flight() {
  static const std::vector<Moment> moments = [] {
    const Scenario scenario = corridor();
    const World world = *make_world(scenario, "");
    const PlannerConfig config;
    support::Loop loop{kWorldZero, support::resting_at(scenario.uav.start, kWorldZero), scenario.uav.limits,
                       scenario.uav.body, config};
    loop.flight_box = scenario.uav.flight_box;
    HorizonRequest first = support::request_at(kWorldZero, loop.committed);
    first.flight_box = scenario.uav.flight_box;
    const TrackSet start = declare_motions(world, kWorldZero, kWorldZero, kWorldZero + Duration{3'500'000});
    const PlanningWorld prepared = support::world_of(start.tracks, support::go_to(scenario.uav.goal), first, config);
    std::vector<Moment> flown;
    while (flown.size() < 400 && (loop.now().p - scenario.uav.goal).norm() > 0.2) {
      Moment moment;
      moment.answer = loop.step([&](const HorizonRequest& request) {
        moment.request = request;
        moment.world = prepared;
        TrackSet set =
            declare_motions(world, kWorldZero, request.header.utime, request.header.utime + Duration{3'500'000});
        moment.world.predictions = std::make_shared<const PredictionProducts>(std::move(set));
        return moment.world;
      });
      flown.push_back(std::move(moment));
    }
    return flown;
  }();
  return moments;
}

double percentile(std::vector<double>& sorted, double share) {
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

/// plan() over the flight's requests; p50, p99, max in ms of the thread's CPU time, and how long the flight was.
void plan_of_a_flight(benchmark::State& state) {
  std::vector<double> ms;
  for (auto _ : state) {
    for (const Moment& m : flight()) {
      Budget budget = Budget::unlimited();
      const double begin = thread_cpu_ms();
      benchmark::DoNotOptimize(plan(m.request, m.world, PlannerConfig{}, budget));
      ms.push_back(thread_cpu_ms() - begin);
    }
  }
  std::sort(ms.begin(), ms.end());
  state.counters["p50_ms"] = percentile(ms, 0.5);
  state.counters["p99_ms"] = percentile(ms, 0.99);
  state.counters["max_ms"] = ms.back();
  state.counters["flight_s"] = 0.05 * static_cast<double>(flight().size());
}
BENCHMARK(plan_of_a_flight)->Unit(benchmark::kMillisecond)->Iterations(1);

SweptObstacles sweep(const std::vector<PlanningObstacle>& obstacles, const Moment& m) {
  std::vector<double> times;
  for (int k = 0; k <= 12; ++k) times.push_back(k * m.answer.trajectory.interval.seconds());
  return {obstacles, m.request.body, m.request.t_s, std::move(times),
          box_around(m.request.start.p, Vec3::Constant(4.0))};
}

/// Moments of the flight whose answer is a new trajectory.
std::vector<const Moment*> planned() {
  std::vector<const Moment*> out;
  for (const Moment& m : flight()) {
    if (m.answer.outcome == PlanOutcome::Optimized || m.answer.outcome == PlanOutcome::SearchOnly) out.push_back(&m);
  }
  return out;
}

/// Cutting the obstacles of a horizon into boxes.
void swept_boxes(benchmark::State& state) {
  const auto moments = planned();
  std::size_t k = 0;
  for (auto _ : state) {
    const Moment& m = *moments[k++ % moments.size()];
    benchmark::DoNotOptimize(sweep(m.world.predictions->obstacles, m).intervals());
  }
}
BENCHMARK(swept_boxes)->Unit(benchmark::kMicrosecond);

/// One hull of a swept obstacle.
void swept_hull(benchmark::State& state) {
  const auto moments = planned();
  std::size_t k = 0;
  std::int64_t hulls = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const Moment& m = *moments[k++ % moments.size()];
    SweptObstacles swept = sweep(m.world.predictions->obstacles, m);
    state.ResumeTiming();
    for (int j = 0; j < 6; ++j) {
      for (const auto& candidate : swept.candidates(j)) benchmark::DoNotOptimize(swept.hull(j, candidate, 0, 1).data());
    }
    hulls += swept.hulls_made();
  }
  state.counters["per_hull"] =
      benchmark::Counter(static_cast<double>(hulls), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(swept_hull)->Unit(benchmark::kMicrosecond);

/// The checker with its hulls made, and what it costs per pair (boxes included).
void check_a_plan(benchmark::State& state) {
  const auto moments = planned();
  std::vector<SweptObstacles> swept;
  for (const Moment* m : moments) swept.push_back(sweep(m->world.predictions->obstacles, *m));
  std::size_t k = 0;
  std::int64_t pairs = 0;
  for (auto _ : state) {
    const std::size_t i = k++ % moments.size();
    const Moment& m = *moments[i];
    const CheckReport report =
        check_plan(m.answer.trajectory, {m.request.start, m.request.limits, m.request.flight_box, 4.0}, swept[i]);
    pairs += report.pairs.by_box + report.pairs.by_plane;
  }
  state.counters["per_pair"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(check_a_plan)->Unit(benchmark::kMicrosecond);

/// One search at the answer's own Δt, hulls included.
void search(benchmark::State& state) {
  const auto moments = planned();
  std::size_t k = 0;
  std::int64_t expansions = 0;
  for (auto _ : state) {
    const Moment& m = *moments[k++ % moments.size()];
    SweptObstacles swept = sweep(m.world.predictions->obstacles, m);
    SearchProblem problem;
    problem.start = m.request.start;
    problem.interval_s = m.answer.trajectory.interval.seconds();
    problem.true_v_max = m.request.limits.v_max;
    problem.limits.v_max *= 0.99;
    problem.sphere_centre = m.request.start.p;
    problem.centre_box = centre_box(m.request.flight_box, m.request.body);
    problem.way.point = m.answer.local_goal;
    Budget budget = Budget::unlimited();
    expansions += semantic_a_star(problem, SearchConfig{}, swept, budget).expansions;
  }
  state.counters["expansions/s"] = benchmark::Counter(static_cast<double>(expansions), benchmark::Counter::kIsRate);
}
BENCHMARK(search)->Unit(benchmark::kMillisecond);

/// Eq. 4 by Ipopt with the answer's own planes.
void optimize(benchmark::State& state) {
  const auto moments = planned();
  std::size_t k = 0;
  std::int64_t iterations = 0;
  for (auto _ : state) {
    const Moment& m = *moments[k++ % moments.size()];
    TrajectoryProblem problem;
    problem.start = m.request.start;
    problem.interval_s = m.answer.trajectory.interval.seconds();
    problem.limits.v_max *= 0.99;
    problem.centre_box = centre_box(m.request.flight_box, m.request.body);
    problem.clearance = m.request.body.radius;
    problem.goal = m.answer.local_goal;
    problem.weight_jerk = OptimizationConfig{}.weight_jerk;
    std::vector<PlaneConstraint> planes;
    for (const CertificatePlane& c : m.answer.certificate) {
      planes.push_back({c.interval, static_cast<double>(c.part) / c.parts, (c.part + 1.0) / c.parts, c.plane});
    }
    const ConvexProblem convex = make_convex_problem(problem, planes, m.answer.trajectory.control_points);
    iterations +=
        solve_by_ipopt(convex, free_variables(m.answer.trajectory.control_points), 60, [] { return false; }).iterations;
  }
  state.counters["iterations"] =
      benchmark::Counter(static_cast<double>(iterations), benchmark::Counter::kAvgIterations);
}
BENCHMARK(optimize)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tern
