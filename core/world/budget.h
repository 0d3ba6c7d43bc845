// A budget that is a clock when live and counts in a replay: why the same log gives the same plan whatever the load.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/world/horizon.h"

namespace tern {

/// Every loop that time may end asks `expired(stage)` once per turn. What asked how often is counted per (attempt,
/// stage); where the gate said stop is kept as a BudgetCut. A replay's gate stops at exactly those counts.
class Budget {
 public:
  /// @return true when the loop must end. Called with how often the loop has asked before, from 0.
  using Gate = std::function<bool(int attempt, Stage stage, std::int64_t count)>;

  explicit Budget(Gate gate) : gate_(std::move(gate)) {}

  /// Never ends anything: the loops' own limits do.
  static Budget unlimited() {
    return Budget([](int, Stage, std::int64_t) { return false; });
  }
  /// Ends loops where the cuts say.
  static Budget replay(std::vector<BudgetCut> cuts) {
    return Budget([cuts = std::move(cuts)](int attempt, Stage stage, std::int64_t count) {
      for (const BudgetCut& cut : cuts) {
        if (cut.attempt == attempt && cut.stage == stage) return count >= cut.count;
      }
      return false;
    });
  }

  /// Starts attempt k (a duration, a local goal): counts begin anew.
  void begin_attempt(int attempt) {
    attempt_ = attempt;
    for (int s = 0; s < kStages; ++s) counts_[s] = 0, spent_[s] = false;
  }

  bool expired(Stage stage) {
    const auto s = static_cast<std::size_t>(stage);
    if (spent_[s]) return true;
    if (!gate_(attempt_, stage, counts_[s])) {
      ++counts_[s];
      return false;
    }
    spent_[s] = true;
    cuts_.push_back({attempt_, stage, counts_[s]});
    return true;
  }

  [[nodiscard]] const std::vector<BudgetCut>& cuts() const { return cuts_; }

 private:
  Gate gate_;
  int attempt_ = 0;
  std::int64_t counts_[kStages] = {};
  bool spent_[kStages] = {};
  std::vector<BudgetCut> cuts_;
};

}  // namespace tern
