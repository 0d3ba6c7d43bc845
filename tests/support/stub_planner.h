// A planner process for empty worlds: the straight plan, after a fixed delay. For tests of everything but planning.
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
  int answers = 1;         ///< how often each request is answered (a contract broken on purpose), ≥ 0
  StraightPlanOptions plan;
};

/// Answers each HORIZON_REQUEST by straight_plan to the newest GOAL (NoPlan, StaleWorld while there is none). Ready at
/// once.
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
