// After warm-up, planning allocates only its results. In this executable malloc counts its calls.
#include <gtest/gtest.h>

#include <vector>

#include "planner/plan_workspace.h"
#include "planner/planner.h"
#include "planner/search/semantic_a_star.h"
#include "tests/planner/optimization/random_problems.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/plan_judge.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kNow{100'000'000};

template <class Work>
long allocations_of(const Work& work) {
  const long before = allocations_so_far();
  work();
  return allocations_so_far() - before;
}

TEST(AllocationCounter, CountsVectorsAndMatrices) {
  std::vector<int> numbers;
  Points points;
  EXPECT_EQ(allocations_of([&] { numbers.assign(100, 1); }), 1);
  EXPECT_EQ(allocations_of([&] { points.setZero(3, 100); }), 1);
  EXPECT_EQ(allocations_of([&] { numbers[0] += static_cast<int>(points.norm()); }), 0);
}

/// A vehicle at rest among movers, with a search ahead.
struct Scene {
  std::vector<Track> tracks;
  std::vector<PlanningObstacle> obstacles;
  Body body;
  std::vector<double> times;
  SearchProblem problem;

  explicit Scene(std::uint64_t seed) {
    Rng rng(seed);
    for (int k = 1; k <= 40; ++k) {
      tracks.push_back(random_mover(rng, k, Box(Vec3(0.8, -3, -2), Vec3(5, 3, 2)), kNow, 3.0));
    }
    obstacles = obstacles_of(tracks);
    problem.interval = Duration{250'000};
    problem.centre_box = Box(Vec3(-4, -4, -4), Vec3(4, 4, 4));
    problem.cost_to_go.point = Vec3(3.9, 0, 0);
    for (int k = 0; k <= 12; ++k) times.push_back(k * problem.interval_s());
  }
};

TEST(Allocation, SweepsAndSearchesAllocateNothingTheSecondTimeButTheResult) {
  SweptHorizon swept;
  SearchMemory memory;
  std::int64_t expansions = 0;
  const Box region = box_around(Vec3::Zero(), Vec3::Constant(4.0));
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Scene scene(seed);
    Budget budget = Budget::unlimited();
    const auto search = [&] {
      SeparationCache& cache = swept.assign(scene.obstacles, scene.body, kNow, scene.times, region);
      const SearchResult result = semantic_a_star(scene.problem, SearchConfig{}, cache, budget, memory);
      expansions += result.expansions;
      return result.found;
    };
    bool found = search();
    EXPECT_LE(allocations_of([&] { found = search(); }), found ? 2 : 0) << "seed " << seed;
  }
  EXPECT_GT(expansions, 1000);
}

TEST(Allocation, ConvexProblemsAndTheirSolverAllocateNothingOnceTheyHaveSeenOneAsLarge) {
  ConvexProblem problem;
  BarrierSolver solver;
  const StopFunction never = [] { return false; };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const support::Instance instance = support::random_instance(seed);
    ConvexSolution solution;
    const auto solve = [&] {
      make_convex_problem(instance.problem, instance.planes, instance.initial, problem);
      solution = solver.solve(problem, free_variables(instance.initial), 60, never);
    };
    solve();
    const FreeVariables first = solution.x;
    EXPECT_EQ(allocations_of(solve), 0) << "seed " << seed;
    EXPECT_EQ(solution.x, first) << "seed " << seed;
    EXPECT_EQ(solution.x, BarrierSolver().solve(instance.convex(), free_variables(instance.initial), 60, never).x);
  }
}

// The remaining allocations: control points, certificates and paths of answer and candidates, and CGAL's hulls.
TEST(Allocation, AWorkspaceChangesNoAnswerAndWhatPlansAllocateDoesNotGrowWithTheWork) {
  constexpr long kOfAnAnswer = 60;
  constexpr long kOfAHull = 450;
  PlannerConfig config;
  PlanWorkspace workspace;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Scene scene(seed);
    const HorizonRequest request = request_at(kNow + Duration{75'000}, resting_at(Vec3::Zero(), kNow));
    const PlanningWorld world = world_of(scene.tracks, go_to(Vec3(20, 0, 0)), request, config);
    const auto once = [&](PlanWorkspace& memory) {
      Budget budget = Budget::unlimited();
      return plan(request, world, config, budget, memory);
    };
    PlanWorkspace fresh;
    const PlanAnswer expected = once(fresh);
    PlanAnswer answer = once(workspace);
    EXPECT_EQ(answer.plan.outcome, expected.plan.outcome);
    EXPECT_EQ(answer.plan.trajectory.control_points, expected.plan.trajectory.control_points) << "seed " << seed;
    const long allocations = allocations_of([&] { answer = once(workspace); });
    EXPECT_LE(allocations, kOfAnAnswer + kOfAHull * answer.statistics.hulls)
        << "seed " << seed << ", " << answer.statistics.expansions << " expansions";
  }
}

}  // namespace
}  // namespace tern
