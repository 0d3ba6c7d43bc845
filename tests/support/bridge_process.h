// Fixtures of tests with a bridge as a real process. The test plays the network on its other side, and what it needs of
// Tern. Runs inside tests/support/hermetic.sh.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/world/vehicle.h"
#include "tests/support/network_end.h"

namespace tern {

/// A bridge. Its output is shown if the test fails.
class BridgeProcess : public ::testing::Test, protected NetworkEnd {
 protected:
  void TearDown() override {
    if (HasFailure() && bridge) end_and_show(*bridge);
  }
  static void end_and_show(Child& child) {
    child.signal(SIGTERM);
    child.wait();
    std::cout << child.output;
  }
  /// Starts the bridge, in place of one before. @param command  the program first
  void start_bridge(std::vector<std::string> command) { bridge = std::make_unique<Child>(std::move(command)); }
  void start_bridge_and_wait(std::vector<std::string> command) {
    start_bridge(std::move(command));
    ASSERT_TRUE(wait_until_ready());
  }
  /// Handles messages of the bus and calls `live` every 2 ms at most, until the condition holds.
  /// @return false if it does not within kPatienceMs
  bool live_until(const std::function<void()>& live, const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatienceMs);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      pollfd fd{lcm->getFileno(), POLLIN, 0};
      poll(&fd, 1, 2);
      drain(*lcm, 1'000);
      bus->rethrow();
      live();
    }
    return true;
  }
  /// Does something at 50 Hz until the condition holds.
  bool repeat_until(const std::function<void()>& what, const std::function<bool()>& condition) {
    UTime next = clock.now();
    const auto live = [&] {
      poll_peer();
      if (clock.now() < next) return;
      what();
      next = clock.now() + Duration{20'000};
    };
    return live_until(live, condition);
  }
  /// Handles what the other side has sent, if it does not by itself.
  virtual void poll_peer() {}

  std::unique_ptr<Child> bridge;
};

/// A bridge, the processes that plan beside it, and their plans.
class BridgeFlight : public BridgeProcess {
 protected:
  BridgeFlight(std::initializer_list<const char*> programs, const std::string& scenario) {
    bus->subscribe(channels::kPlan, [this](const Plan& plan) {
      if (plan.outcome != PlanOutcome::NoPlan) plans[plan.trajectory.start.us] = plan.trajectory;
    });
    for (const char* program : programs) {
      children_.push_back(std::make_unique<Child>(std::vector<std::string>{program, "--config", scenario}));
    }
  }
  void TearDown() override {
    for (const auto& child : children_) {
      if (HasFailure()) end_and_show(*child);
    }
    BridgeProcess::TearDown();
  }
  [[nodiscard]] std::string last_words() const { return beats.empty() ? "no heartbeat" : beats.back().waiting_for; }

  std::map<std::int64_t, TimedSpline> plans;  ///< by the time of their start, µs

 private:
  std::vector<std::unique_ptr<Child>> children_;
};

}  // namespace tern
