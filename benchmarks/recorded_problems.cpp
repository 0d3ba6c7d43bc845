#include "benchmarks/recorded_problems.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "benchmarks/flight_recording.h"
#include "planner/plan_workspace.h"

namespace tern {
namespace {

/// Captures the optimization problem that the search of an answer posed.
std::optional<RecordedProblem> problem_of(const HorizonRequest& request, const PlanningWorld& world, const Plan& answer,
                                          const PlannerConfig& config) {
  if (answer.outcome != PlanOutcome::Optimized && answer.outcome != PlanOutcome::SearchOnly) return std::nullopt;
  PlanWorkspace memory;
  PlanLog log(nullptr);
  Budget budget = Budget::unlimited();
  PlanTools tools{budget, memory, log};
  const Surroundings near = surroundings(request, world, config, memory);
  const Course course{{answer.local_goal, 0.0, 0.0}, {answer.local_goal, 0.0}, 0.0, near.plan_limits, nullptr};
  const Attempt attempt{near, course, horizon_problem(near, answer.trajectory.interval), config.hold_cap_s,
                        config.hold_required_s};
  sweep_horizon(attempt, memory.times, memory.horizon);
  const auto leaf = search_candidate(attempt, config.search, memory.horizon, tools);
  if (!leaf) return std::nullopt;
  const Points& initial = leaf->trajectory.control_points;
  return RecordedProblem{trajectory_problem(attempt, initial),
                         gather_pairs(attempt, leaf->trajectory, memory.horizon, tools), initial};
}

}  // namespace

ConvexProblem RecordedProblem::convex() const {
  std::vector<PlaneConstraint> planes;
  for (const SeparatedPair& pair : pairs) planes.push_back(pair.plane);
  return make_convex_problem(trajectory, planes, initial);
}

void record_problems(std::uint64_t seed, const std::function<bool(const RecordedProblem&)>& take) {
  for (const auto& [world, count] :
       {std::pair{"paper_corridor", 300}, {"mader_corridor", 250}, {"sando_forest", 200}}) {
    const FlightRecording flight = record_flight(fmt::format("{}/{}.yaml", TERN_SCENARIOS, world),
                                                 {fmt::format("seed={}", seed), fmt::format("world.count={}", count)});
    for (const Moment& m : flight.moments) {
      Budget budget = Budget::unlimited();
      const Plan answer = plan(m.request, m.world, flight.config, budget).plan;
      const auto problem = problem_of(m.request, m.world, answer, flight.config);
      if (problem && !take(*problem)) return;
    }
  }
}

}  // namespace tern
