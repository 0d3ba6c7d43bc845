// The best so far of one request: what plan() answers in the end, and the watchdog until then.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Tells the log's observer of every answer that comes to stand.
class StandingAnswer {
 public:
  /// What is committed stands, or no plan. @param blank  what every answer to the request says
  /// @param promised  the predictions' confidence
  StandingAnswer(const Surroundings& near, Plan blank, std::optional<Candidate> committed, double promised,
                 PlanTools& tools);

  [[nodiscard]] const std::optional<Candidate>& committed() const { return committed_; }
  /// The predictions' confidence.
  [[nodiscard]] double promised() const { return promised_; }
  /// What is new.
  [[nodiscard]] const std::optional<Candidate>& best() const { return best_; }

  /// Whether there is something new that leads at least a little of the way to the local goal.
  [[nodiscard]] bool gets_on() const { return best_ && gets_on(*best_); }

  /// From now on, plans head there, and what is committed and what is new are judged by that.
  void head_for(const Heading& heading);
  /// What is committed, certified at less than was looked for so far.
  void keep(std::optional<Candidate> committed, const Heading& heading);
  /// A leaf stands while it is optimized, if it is better than the best; the best stays what it is.
  void announce(const Candidate& leaf);
  /// Takes what is better than the best.
  void take(Candidate candidate);
  /// Takes an evasion, if there is one, whatever stood.
  void replace(std::optional<Candidate> evasion);

  /// The choice. @param reason  why there is nothing new, if there is not
  [[nodiscard]] Plan chosen(PlanReason reason) const;
  /// What is committed, or no plan.
  [[nodiscard]] Plan kept(PlanReason reason) const { return filled(committed_ ? &*committed_ : nullptr, reason); }

 private:
  void tell(const Candidate& candidate);
  [[nodiscard]] bool gets_on(const Candidate& candidate) const;
  [[nodiscard]] bool is_best(const Candidate& candidate) const;
  [[nodiscard]] bool sets_out() const;
  [[nodiscard]] bool puts_off(const Candidate& candidate) const;
  /// than what is committed
  [[nodiscard]] bool is_worse(const Candidate& candidate) const;
  [[nodiscard]] Plan filled(const Candidate* candidate, PlanReason reason) const;

  const Surroundings& near_;
  Plan blank_;
  std::optional<Candidate> committed_, best_;
  double promised_;
  PlanTools& tools_;
};

}  // namespace tern
