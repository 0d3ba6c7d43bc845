#include "planner/optimization/barrier_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/optimization/ipopt_solver.h"
#include "tests/planner/optimization/random_problems.h"

namespace tern {
namespace {

using namespace support;

constexpr int kEnough = 60;  // iterations

bool never() { return false; }

ConvexSolution solve(const Instance& instance) {
  return BarrierSolver().solve(instance.convex(), free_variables(instance.initial), kEnough, never);
}

TEST(SolveByBarrier, FindsIpoptsOptimumToATenThousandth) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const ConvexSolution reference = solve_by_ipopt(p, free_variables(instance.initial), 200, never);
    ASSERT_TRUE(reference.found);
    const ConvexSolution solution = solve(instance);
    ASSERT_TRUE(solution.found) << "seed " << seed;
    ASSERT_FALSE(solution.solver_failed) << "seed " << seed;
    ASSERT_LE(solution.objective, reference.objective * (1.0 + 1e-4) + 1e-6) << "seed " << seed;
  }
}

TEST(SolveByBarrier, EveryAnswerSatisfiesEveryConstraintAndItsGapIsClosed) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const ConvexSolution solution = solve(instance);
    ASSERT_TRUE(solution.found) << "seed " << seed;
    ASSERT_FALSE(solution.solver_failed) << "seed " << seed;
    ASSERT_LE(p.worst_violation(solution.x), 0.0) << "seed " << seed;
    ASSERT_EQ(solution.objective, p.objective(solution.x));
    ASSERT_LE(solution.objective, p.objective(free_variables(instance.initial)));
    ASSERT_GE(solution.gap, 0.0) << "seed " << seed;
    ASSERT_LE(solution.gap, std::max(1.01 * kGapShare * solution.objective, kGapAbsolute)) << "seed " << seed;
  }
}

TEST(SolveByBarrier, NoFeasiblePointIsBetterByMoreThanTheGapOfAnyIterate) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const Eigen::VectorXd x0 = free_variables(instance.initial);
    const ConvexSolution optimum = BarrierSolver().solve(p, x0, kEnough, never);
    for (int n = 1; n < optimum.iterations; ++n) {
      const ConvexSolution early = BarrierSolver().solve(p, x0, n, never);
      if (early.gap < 0.0) continue;
      ASSERT_LE(early.objective - early.gap, optimum.objective + 1e-9) << "seed " << seed << " after " << n;
    }
  }
}

TEST(SolveByBarrier, StoppedAtAnyIterationItHasAFeasibleAnswer) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const Eigen::VectorXd x0 = free_variables(instance.initial);
    double last = p.objective(x0);
    for (int n = 0; n < 16; ++n) {
      int asked = 0;
      const ConvexSolution stopped = BarrierSolver().solve(p, x0, kEnough, [&] { return asked++ >= n; });
      ASSERT_TRUE(stopped.found) << "seed " << seed << " after " << n;
      ASSERT_LE(stopped.iterations, n);
      ASSERT_LE(p.worst_violation(stopped.x), 0.0);
      ASSERT_LE(stopped.objective, last);
      last = stopped.objective;
    }
  }
}

TEST(SolveByBarrier, AsksOncePerStepSoThatAReplayStopsAtTheSameIterate) {
  const Instance instance = random_instance(5);
  const ConvexProblem p = instance.convex();
  const Eigen::VectorXd x0 = free_variables(instance.initial);
  int asked = 0;
  const ConvexSolution stopped = BarrierSolver().solve(p, x0, kEnough, [&] { return asked++ >= 6; });
  const ConvexSolution counted = BarrierSolver().solve(p, x0, 6, never);
  EXPECT_EQ(stopped.iterations, 6);
  EXPECT_EQ(stopped.x, counted.x);
}

TEST(SolveByBarrier, ANumberThatIsNotFiniteIsAFailureAndTheFeasibleStartIsKept) {
  const Instance instance = random_instance(1);
  ConvexProblem p = instance.convex();
  const Eigen::VectorXd x0 = free_variables(instance.initial);
  p.hessian(0, 0) = INFINITY;
  const ConvexSolution solution = BarrierSolver().solve(p, x0, kEnough, never);
  EXPECT_TRUE(solution.solver_failed);
  ASSERT_TRUE(solution.found);
  EXPECT_EQ(solution.x, x0);
}

TEST(SolveByBarrier, WithoutAFeasiblePointThereIsNoAnswer) {
  const Instance instance = random_instance(2);
  ConvexProblem p = instance.convex();
  const FreeVariables first = FreeVariables::Unit(p.variables(), 0);
  const double bound = free_variables(instance.initial)[0] - 0.01;
  p.add_row(first, bound);
  p.add_row(-first, -bound - 0.02);
  EXPECT_FALSE(BarrierSolver().solve(p, free_variables(instance.initial), kEnough, never).found);
}

TEST(SolveByBarrier, AStartOutsideIsLedIn) {
  int outside = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const ConvexSolution reference = solve(instance);
    Eigen::VectorXd away = free_variables(instance.initial);
    for (Eigen::Index i = 0; i < away.size(); ++i) away[i] += (i % 2 == 0 ? 0.3 : -0.3);
    if (p.worst_violation(away) > 0.0) ++outside;
    const ConvexSolution solution = BarrierSolver().solve(p, away, kEnough, never);
    ASSERT_TRUE(solution.found) << "seed " << seed;
    ASSERT_NEAR(solution.objective, reference.objective, 1e-4 * reference.objective + 1e-6) << "seed " << seed;
  }
  EXPECT_GT(outside, 80);
}

TEST(SolveByBarrier, SolvesTheSameProblemToTheSameBits) {
  const Instance instance = random_instance(7);
  const ConvexSolution first = solve(instance);
  (void)solve(random_instance(8));
  const ConvexSolution second = solve(instance);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.iterations, second.iterations);
  EXPECT_EQ(first.gap, second.gap);
}

}  // namespace
}  // namespace tern
