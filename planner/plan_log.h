// Observation of plan() while it runs: for the watchdog, for timing, for statistics.
#pragma once

#include <cstdint>

#include "core/world/budget.h"
#include "core/world/horizon.h"
#include "planner/safety/interval_separation.h"

namespace tern {

struct PlanWorkspace;
struct SearchProblem;
struct SearchResult;

/// Receives the steps of plan() as they happen: for timing, and so that a watchdog always has an answer.
class PlanObserver {
 public:
  virtual ~PlanObserver() = default;
  virtual void enter(Stage stage) = 0;               ///< called when work of this stage begins
  virtual void answer(const Plan& best_so_far) = 0;  ///< called for each new incumbent; the first is the fallback
  /// Called after each search.
  virtual void searched(const SearchProblem&, SeparationCache&, const SearchResult&) {}
  /// Returns whether the next search keeps its nodes for searched().
  [[nodiscard]] virtual bool wants_search_nodes() const { return false; }
};

/// The work of one answer in counts. Times are the observer's.
struct PlanStatistics {
  std::int64_t expansions = 0;      ///< search nodes expanded
  std::int64_t hulls = 0;           ///< hulls made by CGAL
  std::int64_t pairs_by_index = 0;  ///< pairs of obstacle and interval out of the vehicle's reach
  PairCounts pairs;
  std::int64_t solver_calls = 0, solver_iterations = 0;

  void count(const SeparationCache& swept) {
    hulls += swept.hulls_made();
    pairs_by_index += swept.obstacles().pairs_out_of_reach();
  }
};

/// The statistics of one call, and its observer if there is one.
class PlanLog {
 public:
  explicit PlanLog(PlanObserver* observer) : observer_(observer) {}

  void enter(Stage stage) {
    if (observer_ != nullptr) observer_->enter(stage);
  }
  void searched(const SearchProblem& problem, SeparationCache& swept, const SearchResult& result) {
    if (observer_ != nullptr) observer_->searched(problem, swept, result);
  }
  [[nodiscard]] bool wants_search_nodes() const { return observer_ != nullptr && observer_->wants_search_nodes(); }
  [[nodiscard]] PlanObserver* observer() { return observer_; }

  PlanStatistics statistics;

 private:
  PlanObserver* observer_;
};

/// The objects that the steps of one call change.
struct PlanTools {
  Budget& budget;
  PlanWorkspace& memory;
  PlanLog& log;
};

}  // namespace tern
