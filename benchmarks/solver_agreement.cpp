// Compares the barrier method with Ipopt's optimum on problems recorded from flights. Exits with 1 if a cost exceeds
// Ipopt's by a ten-thousandth.
#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/recorded_problems.h"
#include "core/base/percentiles.h"
#include "planner/optimization/barrier_solver.h"
#include "planner/optimization/ipopt_solver.h"
#include "runtime/command_line.h"
#include "runtime/stopwatch.h"

namespace tern {
namespace {

constexpr double kAllowed = 1e-4;  ///< relative excess over Ipopt's cost
constexpr double kMinCost = 1e-2;  ///< m²: smaller costs are compared as if they were this
constexpr int kIterations = 200;

struct Comparison {
  std::vector<double> barrier_ms, ipopt_ms, steps, excess, gap;
  int unsolved = 0, ipopt_unsolved = 0;

  void add(const RecordedProblem& recorded) {
    const ConvexProblem problem = recorded.convex();
    const Eigen::VectorXd x0 = free_variables(recorded.initial);
    const auto never = [] { return false; };
    const double begin = thread_cpu_ms();
    const ConvexSolution barrier = BarrierSolver().solve(problem, x0, kIterations, never);
    const double between = thread_cpu_ms();
    const ConvexSolution ipopt = solve_by_ipopt(problem, x0, kIterations, never);
    barrier_ms.push_back(between - begin);
    ipopt_ms.push_back(thread_cpu_ms() - between);
    steps.push_back(barrier.iterations);
    const double cost = std::max(ipopt.objective, kMinCost);
    excess.push_back((barrier.objective - ipopt.objective) / cost);
    gap.push_back(barrier.gap / cost);
    if (!barrier.found || barrier.solver_failed) ++unsolved;
    if (!ipopt.found || ipopt.solver_failed) ++ipopt_unsolved;
    if (excess.back() > kAllowed || barrier.solver_failed) {
      fmt::print("problem {}: barrier {:.9g} after {} steps (gap {:.2g}), Ipopt {:.9g}, start {:.9g}\n", excess.size(),
                 barrier.objective, barrier.iterations, barrier.gap, ipopt.objective, problem.objective(x0));
    }
  }

  [[nodiscard]] int exceeded() const {
    return static_cast<int>(std::count_if(excess.begin(), excess.end(), [](double e) { return e > kAllowed; }));
  }
};

void print(const char* name, const std::vector<double>& values) {
  const Percentiles p = percentiles(values);
  if (!values.empty()) fmt::print("{:<22} p50 {:9.3g}   p99 {:9.3g}   max {:9.3g}\n", name, p.p50, p.p99, p.max);
}

int compare(int count, std::uint64_t seed) {
  Comparison comparison;
  for (; static_cast<int>(comparison.excess.size()) < count; ++seed) {
    record_problems(seed, [&](const RecordedProblem& problem) {
      comparison.add(problem);
      return static_cast<int>(comparison.excess.size()) < count;
    });
  }
  fmt::print("{} problems, {} cost more than Ipopt's by over {}, barrier failed on {}, Ipopt on {}\n",
             comparison.excess.size(), comparison.exceeded(), kAllowed, comparison.unsolved, comparison.ipopt_unsolved);
  print("barrier, ms", comparison.barrier_ms);
  print("Ipopt, ms", comparison.ipopt_ms);
  print("barrier, steps", comparison.steps);
  print("excess over Ipopt", comparison.excess);
  print("certified gap", comparison.gap);
  return comparison.exceeded() == 0 && comparison.unsolved == 0 ? 0 : 1;
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  tern::CommandLine app("Compares the solvers of Eq. 4 with fixed planes on problems recorded from flights.");
  int count = 10'000;
  std::uint64_t seed = 1;
  app.add_option("--count", count, "how many problems")->capture_default_str();
  app.add_option("--seed", seed, "the first world's seed")->capture_default_str();
  if (const auto code = app.parse(argc, argv, 2)) return *code;
  return tern::compare(count, seed);
}
