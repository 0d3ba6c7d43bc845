// The incumbent: the best candidate so far of one request, the committed trajectory included.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Keeps the committed trajectory and the best new candidate of one request, and chooses between them.
///
/// | call                | effect                                                                               |
/// |---------------------|--------------------------------------------------------------------------------------|
/// | constructor         | the committed trajectory, or no plan, is reported                                    |
/// | set_course()        | both are evaluated for the new course                                                |
/// | replace_committed() | the committed trajectory is replaced, e.g. by itself at a reduced assurance          |
/// | report_leaf()       | the leaf is reported if it beats the best; the best stays                            |
/// | offer()             | the candidate becomes the best and is reported, if it beats the best                 |
/// | replace_best()      | the evasion becomes the best and is reported                                         |
/// | choose()            | returns the plan: the best, or the committed trajectory if the best is worse         |
///
/// Candidates are reported to the log's observer, so that the watchdog has an answer at any time. A candidate that is
/// worse than the committed trajectory is not reported. The order of candidates is in docs/planner/choice.md.
class Incumbent {
 public:
  /// @param blank           the fields that are the same in every answer to the request
  /// @param committed       the committed trajectory; nullopt if it is not clear
  /// @param set_confidence  confidence of the prediction set
  Incumbent(const Surroundings& near, Plan blank, std::optional<Candidate> committed, double set_confidence,
            PlanTools& tools);

  [[nodiscard]] const std::optional<Candidate>& committed() const { return committed_; }
  [[nodiscard]] double set_confidence() const { return set_confidence_; }
  /// Returns the best new candidate.
  [[nodiscard]] const std::optional<Candidate>& best() const { return best_; }

  /// Returns whether the best new candidate ends nearer to the local goal, by more than kMinProgress of the distance.
  [[nodiscard]] bool makes_progress() const { return best_ && makes_progress(*best_); }

  void set_course(const Course& course);
  void replace_committed(std::optional<Candidate> committed, const Course& course);
  void report_leaf(const Candidate& leaf);
  void offer(Candidate candidate);
  /// For nullopt it does nothing.
  void replace_best(std::optional<Candidate> evasion);

  /// @param reason  the reason that is given if there is no new candidate
  [[nodiscard]] Plan choose(PlanReason reason) const;
  /// Returns the committed trajectory as the plan, or no plan if there is none.
  [[nodiscard]] Plan committed_plan(PlanReason reason) const {
    return filled(committed_ ? &*committed_ : nullptr, reason);
  }

 private:
  void report(const Candidate& candidate);
  [[nodiscard]] bool makes_progress(const Candidate& candidate) const;
  [[nodiscard]] bool is_better_than_best(const Candidate& candidate) const;
  [[nodiscard]] bool departs_from_rest() const;
  [[nodiscard]] bool is_delayed(const Candidate& candidate) const;
  [[nodiscard]] bool is_worse_than_committed(const Candidate& candidate) const;
  [[nodiscard]] Plan filled(const Candidate* candidate, PlanReason reason) const;

  const Surroundings& near_;
  Plan blank_;
  std::optional<Candidate> committed_, best_;
  double set_confidence_;
  PlanTools& tools_;
};

}  // namespace tern
