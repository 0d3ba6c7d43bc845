// plan(): one request, one certified answer. Pure: no clock, no log, no state; time enters only through the Budget.
#pragma once

#include "core/world/budget.h"
#include "core/world/horizon.h"
#include "planner/planner_config.h"
#include "planner/planning_world.h"
#include "planner/safety/separation_test.h"

namespace tern {

struct PlanWorkspace;
struct SearchProblem;
struct SearchResult;

/// Is told what plan() does while it does it: for timing, and so that a watchdog always has an answer.
class PlanObserver {
 public:
  virtual ~PlanObserver() = default;
  virtual void enter(Stage stage) = 0;               ///< work of this stage begins
  virtual void answer(const Plan& best_so_far) = 0;  ///< a (better) answer stands; the first is the fallback
  /// A search has ended: for those who judge searches.
  virtual void searched(const SearchProblem&, SweptObstacles&, const SearchResult&) {}
  /// Whether the nodes of searches shall be kept for searched(); asked before each.
  [[nodiscard]] virtual bool wants_search_nodes() const { return false; }
};

/// What the answer cost in things that can be counted (times are the observer's).
struct PlanStatistics {
  std::int64_t expansions = 0;
  std::int64_t hulls = 0;           ///< made by CGAL
  std::int64_t pairs_by_index = 0;  ///< pairs of obstacle and interval dropped because they cannot reach the vehicle
  PairCounts pairs;
  std::int64_t solver_calls = 0, solver_iterations = 0;

  void count(const SweptObstacles& swept) {
    hulls += swept.hulls_made();
    pairs_by_index += swept.pairs_out_of_reach();
  }
};

struct PlanAnswer {
  Plan plan;  ///< header empty
  PlanStatistics statistics;
};

/// Plans from request.start within the sphere of radius r around it (paper §2), in this order:
///  1. the committed trajectory is checked against these predictions: the fallback;
///  2. a start inside a hull seeks room first; else the path around static obstacles gives the local goal, and the
///     semantic A* looks for a leaf at a few durations;
///  3. each leaf is optimized by Eq. 4 (`planner.optimization.method`; `alternating`: with its planes fixed);
///  4. if neither that nor the committed trajectory holds long enough, an evasion is sought;
///  5. the best certified trajectory is chosen: separated, hold long enough, least time to the goal, in that order.
/// Every trajectory in an answer has passed check_plan() or check_separation(). Deterministic in its arguments; the
/// workspace is memory, never meaning.
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanWorkspace& workspace, PlanObserver* observer = nullptr);
/// The same with memory of its own.
PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer = nullptr);

}  // namespace tern
