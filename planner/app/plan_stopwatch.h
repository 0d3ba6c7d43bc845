// Measures one call of plan(): PLAN_TIMING, and the answers on the way for the watchdog.
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
  /// @param clock_ms  what its times are read from: monotonic_ms, or thread_cpu_ms where only work shall count
  PlanStopwatch(std::function<void(const Plan&)> improved, double (*clock_ms)())
      : improved_(std::move(improved)), clock_ms_(clock_ms) {}

  void enter(Stage stage) override;
  void answer(const Plan& best_so_far) override;
  /// From now on, searches are kept.
  void keep_search() { keeps_search_ = true; }
  [[nodiscard]] bool wants_search_nodes() const override { return keeps_search_; }
  void searched(const SearchProblem&, SweptObstacles&, const SearchResult& result) override;
  /// The nodes of the last search that was kept.
  [[nodiscard]] std::vector<SearchViewNode> take_nodes() { return std::move(nodes_); }
  /// What has been measured; call it when plan() is done.
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
  double first_answer_ms_ = 0.0;  ///< of the first certified trajectory that is new
};

}  // namespace tern
