// The observer of one call of plan(): measures PLAN_TIMING and passes incumbents to the watchdog.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/world/search_view.h"
#include "planner/planner.h"
#include "runtime/stopwatch.h"

namespace tern {

class PlanStopwatch final : public PlanObserver {
 public:
  /// @param improved  is called with every incumbent
  /// @param clock_ms  the clock of the times: monotonic_ms, or thread_cpu_ms to count work alone
  PlanStopwatch(std::function<void(const Plan&)> improved, double (*clock_ms)())
      : improved_(std::move(improved)), clock_ms_(clock_ms) {}

  void enter(Stage stage) override;
  void answer(const Plan& best_so_far) override;
  /// Makes later searches keep their nodes.
  void keep_search() { keeps_search_ = true; }
  [[nodiscard]] bool wants_search_nodes() const override { return keeps_search_; }
  void searched(const SearchProblem&, SeparationCache&, const SearchResult& result) override;
  /// Returns the nodes of the last search.
  [[nodiscard]] std::vector<SearchViewNode> take_nodes() { return std::move(nodes_); }
  /// Returns the measurements. Call it after plan() has returned.
  [[nodiscard]] PlanTiming timing(const PlanAnswer& answer);

 private:
  void close_stage();

  std::function<void(const Plan&)> improved_;
  double (*clock_ms_)();
  double started_ms_ = clock_ms_(), stage_started_ms_ = started_ms_;
  double cpu_at_start_ms_ = thread_cpu_ms();
  Stage stage_ = Stage::Fallback;
  double stage_ms_[kStages] = {};
  bool keeps_search_ = false;
  std::vector<SearchViewNode> nodes_;
  double first_answer_ms_ = 0.0;  ///< until the first new certified trajectory; 0: none yet
};

}  // namespace tern
