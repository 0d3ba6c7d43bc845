// The best so far of one request: what plan() answers in the end, and the watchdog until then.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Tells the log's observer of every answer that comes to stand.
class Incumbent {
 public:
  /// What is committed stands, or no plan. @param blank  what every answer to the request says
  /// @param set_confidence  the predictions' confidence
  Incumbent(const Surroundings& near, Plan blank, std::optional<Candidate> committed, double set_confidence,
            PlanTools& tools);

  [[nodiscard]] const std::optional<Candidate>& committed() const { return committed_; }
  /// The predictions' confidence.
  [[nodiscard]] double set_confidence() const { return set_confidence_; }
  /// What is new.
  [[nodiscard]] const std::optional<Candidate>& best() const { return best_; }

  /// Whether there is something new that leads at least a little of the way to the local goal.
  [[nodiscard]] bool makes_progress() const { return best_ && makes_progress(*best_); }

  /// From now on, plans head there, and what is committed and what is new are judged by that.
  void set_course(const Course& course);
  /// What is committed, certified at less than was looked for so far.
  void replace_committed(std::optional<Candidate> committed, const Course& course);
  /// A leaf stands while it is optimized, if it is better than the best; the best stays what it is.
  void report_leaf(const Candidate& leaf);
  /// Takes what is better than the best.
  void offer(Candidate candidate);
  /// Takes an evasion, if there is one, whatever stood.
  void replace_best(std::optional<Candidate> evasion);

  /// The choice. @param reason  why there is nothing new, if there is not
  [[nodiscard]] Plan choose(PlanReason reason) const;
  /// What is committed, or no plan.
  [[nodiscard]] Plan committed_plan(PlanReason reason) const {
    return filled(committed_ ? &*committed_ : nullptr, reason);
  }

 private:
  void report(const Candidate& candidate);
  [[nodiscard]] bool makes_progress(const Candidate& candidate) const;
  [[nodiscard]] bool is_better_than_best(const Candidate& candidate) const;
  [[nodiscard]] bool departs_from_rest() const;
  [[nodiscard]] bool is_delayed(const Candidate& candidate) const;
  /// than what is committed
  [[nodiscard]] bool is_worse_than_committed(const Candidate& candidate) const;
  [[nodiscard]] Plan filled(const Candidate* candidate, PlanReason reason) const;

  const Surroundings& near_;
  Plan blank_;
  std::optional<Candidate> committed_, best_;
  double set_confidence_;
  PlanTools& tools_;
};

}  // namespace tern
