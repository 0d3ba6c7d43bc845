// A network of one planner and one listener on memq://, under a clock that two threads may share.
#pragma once

#include <atomic>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <vector>

#include "runtime/bus.h"
#include "runtime/lcm_network.h"

namespace tern::support {

/// A clock that moves only when the test advances it; a worker may read it meanwhile.
class SharedClock final : public Clock {
 public:
  explicit SharedClock(UTime start) : us_(start.us) {}
  [[nodiscard]] UTime now() const override { return {us_.load()}; }
  void advance_to(UTime t) { us_ = t.us; }

 private:
  std::atomic<std::int64_t> us_;
};

/// Receives every answer.
class Answers {
 public:
  Answers(const std::shared_ptr<lcm::LCM>& lcm, const Clock& clock) : lcm_(lcm), bus_(lcm, clock, 999) {
    bus_.subscribe(channels::kPlan, [this](const Plan& plan) { plans.push_back(plan); });
    bus_.subscribe(channels::kPlanTiming, [this](const PlanTiming& timing) { timings.push_back(timing); });
  }

  void hear() {
    drain(*lcm_, 1000);
    bus_.rethrow();
  }
  [[nodiscard]] std::map<std::int64_t, int> per_request() const {
    std::map<std::int64_t, int> count;
    for (const Plan& plan : plans) ++count[plan.request_id];
    return count;
  }
  [[nodiscard]] Bus& bus() { return bus_; }

  std::vector<Plan> plans;
  std::vector<PlanTiming> timings;

 private:
  std::shared_ptr<lcm::LCM> lcm_;
  Bus bus_;
};

}  // namespace tern::support
