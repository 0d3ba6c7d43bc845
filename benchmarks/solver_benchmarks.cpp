// Cost of Eq. 4 by each method on problems recorded from flights, and of making the problem. The cost reached is the
// mean over the problems, as a share of the search's.
#include "benchmarks/in_turn.h"
#include "benchmarks/recorded_problems.h"
#include "planner/optimization/barrier_solver.h"
#include "planner/optimization/ipopt_solver.h"

namespace tern {
namespace {

constexpr int kProblems = 100;  // the same for each method, so that costs can be compared

bool never() { return false; }
bool anything(const Eigen::VectorXd&) { return true; }

/// Every tenth problem of the flights.
const std::vector<RecordedProblem>& problems() {
  static const std::vector<RecordedProblem> all = [] {
    std::vector<RecordedProblem> taken;
    int k = 0;
    record_problems(1, [&](const RecordedProblem& p) {
      if (k++ % 10 == 0) taken.push_back(p);
      return true;
    });
    return taken;
  }();
  return all;
}

template <class Solve>
void run(benchmark::State& state, const Solve& solve) {
  double share = 0.0;
  double steps = 0.0;
  std::size_t k = 0;
  for (auto _ : state) {
    const RecordedProblem& p = problems()[k++ % problems().size()];
    const ConvexProblem convex = p.convex();
    const ConvexSolution solution = solve(p, convex);
    state.PauseTiming();
    const double before = convex.objective(free_variables(p.initial));
    share += solution.found && before > 0.0 ? solution.objective / before : 1.0;
    steps += solution.iterations;
    state.ResumeTiming();
  }
  state.counters["cost"] = benchmark::Counter(share, benchmark::Counter::kAvgIterations);
  state.counters["steps"] = benchmark::Counter(steps, benchmark::Counter::kAvgIterations);
}

void make_problem(benchmark::State& state) {
  in_turn(state, problems(), [](const RecordedProblem& p) { return p.convex().bounds.data(); });
}
BENCHMARK(make_problem)->Unit(benchmark::kMicrosecond);

void solve_barrier(benchmark::State& state) {
  run(state, [](const RecordedProblem& p, const ConvexProblem& convex) {
    return BarrierSolver().solve(convex, free_variables(p.initial), 60, never);
  });
}
BENCHMARK(solve_barrier)->Unit(benchmark::kMicrosecond)->Iterations(kProblems);

void solve_ipopt(benchmark::State& state) {
  run(state, [](const RecordedProblem& p, const ConvexProblem& convex) {
    return solve_by_ipopt(convex, free_variables(p.initial), 60, never);
  });
}
BENCHMARK(solve_ipopt)->Unit(benchmark::kMicrosecond)->Iterations(kProblems);

void joint(benchmark::State& state) {
  run(state, [](const RecordedProblem& p, const ConvexProblem&) {
    return solve_joint(JointProblem(p.trajectory, p.pairs, p.initial), 60, never, anything);
  });
}
BENCHMARK(joint)->Unit(benchmark::kMicrosecond)->Iterations(kProblems);

void joint_from_alternating(benchmark::State& state) {
  run(state, [](const RecordedProblem& p, const ConvexProblem& convex) {
    const ConvexSolution first = BarrierSolver().solve(convex, free_variables(p.initial), 60, never);
    const Points from = control_points_of(first.x, p.trajectory);
    const ConvexSolution second = solve_joint(JointProblem(p.trajectory, p.pairs, from), 60, never, anything);
    return second.found ? second : first;
  });
}
BENCHMARK(joint_from_alternating)->Unit(benchmark::kMicrosecond)->Iterations(kProblems);

}  // namespace
}  // namespace tern
