// A planner process for empty worlds: it sends the straight plan after a fixed delay.
#pragma once

#include <deque>
#include <optional>

#include "core/world/goal.h"
#include "runtime/bus.h"
#include "runtime/node.h"
#include "tests/support/straight_plan.h"

namespace tern {

struct StubPlannerOptions {
  Duration delay{10'000};  ///< from a request to its answer, ≥ 0
  int answers = 1;  ///< number of answers to each request, ≥ 0; other numbers than 1 break the contract on purpose
  StraightPlanOptions plan;
};

/// Answers each HORIZON_REQUEST by straight_plan() to the newest GOAL. Without a GOAL the answer is NoPlan,
/// StaleWorld. It is ready at once.
class StubPlannerNode final : public Node {
 public:
  explicit StubPlannerNode(Bus& bus, const StubPlannerOptions& options = {});

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }

 private:
  struct Pending {
    HorizonRequest request;
    UTime answer_at;
  };
  Bus& bus_;
  StubPlannerOptions options_;
  std::optional<Goal> goal_;
  std::deque<Pending> pending_;
};

}  // namespace tern
