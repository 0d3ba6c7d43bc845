// A budget that is a clock when live and counts in a replay: why the same log gives the same plan whatever the load.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/world/horizon.h"

namespace tern {

/// Every loop that time may end asks `expired(stage)` once per turn. What asked how often is counted per attempt and
/// stage; where the gate said stop is kept as a BudgetCut. A replay's gate stops at exactly those counts.
class Budget {
 public:
  /// @return true when the loop must end here: its count is how often it has asked before, from 0.
  using Gate = std::function<bool(const BudgetCut& here)>;

  explicit Budget(Gate gate) : gate_(std::move(gate)) {}

  /// Never ends anything: the loops' own limits do.
  static Budget unlimited() {
    return Budget([](const BudgetCut&) { return false; });
  }
  /// Ends loops where the cuts say.
  static Budget replay(std::vector<BudgetCut> cuts) {
    return Budget([cuts = std::move(cuts)](const BudgetCut& here) {
      for (const BudgetCut& cut : cuts) {
        if (cut.phase == here.phase && cut.attempt == here.attempt && cut.stage == here.stage) {
          return here.count >= cut.count;
        }
      }
      return false;
    });
  }

  /// Starts the next attempt of a phase: counts begin anew. @return false: it has had kMaxAttempts
  bool begin_attempt(Phase phase) {
    int& begun = begun_[idx(phase)];
    if (begun == kMaxAttempts) return false;
    phase_ = phase;
    attempt_ = begun++;
    for (int s = 0; s < kStages; ++s) counts_[s] = 0, spent_[s] = false;
    return true;
  }

  bool expired(Stage stage) {
    const auto s = idx(stage);
    if (spent_[s]) return true;
    const BudgetCut here{phase_, attempt_, stage, counts_[s]};
    if (!gate_(here)) {
      ++counts_[s];
      return false;
    }
    spent_[s] = true;
    cuts_.push_back(here);
    return true;
  }

  [[nodiscard]] const std::vector<BudgetCut>& cuts() const { return cuts_; }

 private:
  Gate gate_;
  Phase phase_ = Phase::Durations;
  int attempt_ = 0;
  int begun_[kPhases] = {};
  std::int64_t counts_[kStages] = {};
  bool spent_[kStages] = {};
  std::vector<BudgetCut> cuts_;
};

}  // namespace tern
