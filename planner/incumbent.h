// The incumbent: the best candidate so far of one request, the committed trajectory included.
#pragma once

#include <optional>

#include "planner/attempt.h"
#include "planner/schedule.h"

namespace tern {

/// Keeps the committed trajectory and the best new candidate of one request, and chooses between them by preference.h.
///
/// | call                | effect                                                                               |
/// |---------------------|--------------------------------------------------------------------------------------|
/// | constructor         | the committed trajectory is kept, if it is clear                                     |
/// | set_course()        | both are evaluated for the new course                                                |
/// | replace_committed() | the committed trajectory is replaced, e.g. by itself at a reduced assurance          |
/// | report_leaf()       | if the leaf beats the best, the observer is told the answer with it; the best stays  |
/// | offer()             | the candidate becomes the best, if it beats the best                                 |
/// | offer_stop()        | the stop becomes the best: for the aim Room always, for the aim Stop if it stays     |
/// |                     | clear longer than the best and the committed trajectory                              |
/// | answer()            | returns the plan: the best, or the committed trajectory if the best does not         |
/// |                     | replace it                                                                           |
///
/// The log's observer is told after each change what the answer would be now, so that the watchdog has one at any time.
/// A leaf counts until its refined form is offered, which may be no better than the best.
class Incumbent {
 public:
  /// @param near       at full assurance
  /// @param blank      the fields that are the same in every answer to the request
  /// @param committed  the committed trajectory; nullopt if it is not clear
  Incumbent(const Surroundings& near, Plan blank, std::optional<Candidate> committed, PlanTools& tools);

  [[nodiscard]] const std::optional<Candidate>& committed() const { return committed_; }
  /// Returns the best new candidate.
  [[nodiscard]] const std::optional<Candidate>& best() const { return best_; }

  void set_course(const Course& course);
  void replace_committed(std::optional<Candidate> committed, const Course& course);
  void report_leaf(const Candidate& leaf);
  void offer(Candidate candidate);
  /// For nullopt it does nothing.
  void offer_stop(std::optional<Candidate> stop, Aim aim);

  /// @param reason  the reason that is given if there is no new candidate
  [[nodiscard]] Plan answer(PlanReason reason) const;

 private:
  [[nodiscard]] bool beats_best(const Candidate& candidate) const;
  /// Tells the observer the answer if planning ended here with this best candidate.
  void report(const std::optional<Candidate>& best);
  [[nodiscard]] Plan answer_with(const std::optional<Candidate>& best, PlanReason reason) const;
  [[nodiscard]] Plan filled(const Candidate* candidate, PlanReason reason) const;

  const Surroundings& near_;
  Plan blank_;
  std::optional<Candidate> committed_, best_;
  bool leaf_stands_ = false;  ///< the observer was last told the answer with a leaf
  PlanTools& tools_;
};

}  // namespace tern
