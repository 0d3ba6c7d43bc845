// The budget of a planning attempt. In a flight it asks a clock; in a replay it counts. The same log therefore gives
// the same plan on every machine.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/world/horizon.h"

namespace tern {

/// Ends loops when time is up. Every such loop calls expired(stage) once per turn. The calls are counted per attempt
/// and stage; a call that ends a loop is recorded as a BudgetCut. A replay ends the loops at the recorded counts.
class Budget {
 public:
  /// Returns true if the loop must end. `here.count` is the number of its earlier calls.
  using Gate = std::function<bool(const BudgetCut& here)>;

  explicit Budget(Gate gate) : gate_(std::move(gate)) {}

  /// Returns a budget that never ends a loop.
  static Budget unlimited() {
    return Budget([](const BudgetCut&) { return false; });
  }
  /// Returns a budget that ends loops at the given cuts.
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

  /// Starts the next attempt of a phase and sets all counts to 0. @return false if the phase has had kMaxAttempts
  bool begin_attempt(Phase phase) {
    int& begun = begun_[idx(phase)];
    if (begun == kMaxAttempts) return false;
    phase_ = phase;
    attempt_ = begun++;
    for (int s = 0; s < kStages; ++s) counts_[s] = 0, spent_[s] = false;
    return true;
  }

  /// True if the loop of this stage must end. Once true, it stays true for the rest of the attempt.
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

  /// Returns the cuts of all attempts, in their order.
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
